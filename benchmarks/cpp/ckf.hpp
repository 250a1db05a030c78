// The textbook's cubature filter in covariance form, with Eigen; sizes known when it is compiled, or when it runs.
#pragma once
#include "models.hpp"

template <class Model> struct Ckf {
    static constexpr int N = Model::N, D = Model::D, P2 = N == Eigen::Dynamic ? Eigen::Dynamic : 2 * N;
    using Vector = Matrix<double, N, 1>;
    using Square = Matrix<double, N, N>;
    Model model;
    Vector m;
    Square P, Q;
    Matrix<double, D, 1> r, e;
    Matrix<double, N, P2> X, F;
    Matrix<double, D, P2> Z;
    Matrix<double, D, D> S;
    Matrix<double, N, D> C, K;
    // where the last prediction came from: Cov[before, after]
    Square cross;

    explicit Ckf(const Model& model)
        : model(model), m(model.mean()), P(model.variances().asDiagonal()), Q(model.Q()), r(model.r()), X(model.n, 2 * model.n),
          F(model.n, 2 * model.n), Z(model.d, 2 * model.n), S(model.d, model.d), C(model.n, model.d) {}

    // Deviations of the points from the mean: X = [L, -L] sqrt(n).
    void spread() {
        int n = model.n;
        Eigen::LLT<Square> llt(P);
        X.leftCols(n) = Square(llt.matrixL()) * std::sqrt(double(n));
        X.rightCols(n) = -X.leftCols(n);
    }

    // Eigen hands larger products to a kernel with packing, which is slow where the sizes are known and small.
    template <class A, class B, class To> static void product(const A& a, const B& b, To& to) {
        if constexpr (N == Eigen::Dynamic) to.noalias() = a * b;
        else to.noalias() = a.lazyProduct(b);
    }

    static void covariance(const Matrix<double, N, P2>& deviations, Square& to) {
        if constexpr (N == Eigen::Dynamic) {
            to.setZero(deviations.rows(), deviations.rows());
            to.template selfadjointView<Eigen::Lower>().rankUpdate(deviations);
            to.template triangularView<Eigen::StrictlyUpper>() = to.transpose();
        } else {
            product(deviations, deviations.transpose(), to);
        }
        to /= double(deviations.cols());
    }

    void predict(bool smoothing = false) {
        spread();
        for (int j = 0; j < X.cols(); j++) {
            Vector x = m + X.col(j);
            model.step(x, F.col(j));
        }
        m = F.rowwise().mean();
        F.colwise() -= m;
        covariance(F, P);
        P += Q;
        if (smoothing) {
            product(X, F.transpose(), cross);
            cross /= double(X.cols());
        }
    }

    void update(const double* z) {
        spread();
        for (int j = 0; j < X.cols(); j++) {
            Vector x = m + X.col(j);
            model.see(x, Z.col(j));
        }
        e = Z.rowwise().mean();
        Z.colwise() -= e;
        product(Z, Z.transpose(), S);
        S /= double(X.cols());
        S.diagonal() += r;
        product(X, Z.transpose(), C);
        C /= double(X.cols());
        Eigen::LLT<Matrix<double, D, D>> llt(S);
        K = llt.solve(C.transpose()).transpose();
        e = Eigen::Map<const Matrix<double, D, 1>>(z, model.d) - e;
        m += K * e;
        P.noalias() -= K * C.transpose();
    }
};

// One row of a smoother's record.
template <class Filter> struct Record {
    typename Filter::Vector m, ahead_m;
    typename Filter::Square P, ahead_P, cross;
};

// Rauch, Tung and Striebel: the records become the smoothed beliefs.
template <class Filter> void smooth(std::vector<Record<Filter>>& records) {
    for (size_t k = records.size() - 1; k-- > 0;) {
        auto &now = records[k], &next = records[k + 1];
        Eigen::LLT<typename Filter::Square> llt(next.ahead_P);
        typename Filter::Square gain = llt.solve(next.cross.transpose()).transpose();
        now.m += gain * (next.m - next.ahead_m);
        now.P += gain * (next.P - next.ahead_P) * gain.transpose();
    }
}
