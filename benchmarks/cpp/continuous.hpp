// Predictions of the turn in space in continuous time, in covariance form.
#pragma once
#include "ckf.hpp"

// Mean and covariance by their differential equations, equal steps of the classic Runge-Kutta method.
struct MomentOde : Ckf<Space> {
    using Ckf<Space>::Ckf;
    void slopes(const Vector& m, const Square& P, Vector& dm, Square& dP) {
        Eigen::LLT<Square> llt(P);
        Square L = Square(llt.matrixL()) * std::sqrt(7.0);
        for (int j = 0; j < 7; j++) {
            F.col(j) = Space::drift(Vector(m + L.col(j)));
            F.col(7 + j) = Space::drift(Vector(m - L.col(j)));
        }
        dm = F.rowwise().mean();
        Matrix<double, 7, 7> half = F.leftCols<7>() - F.rightCols<7>();
        Square A = L.lazyProduct(half.transpose()) / 14;
        dP = A + A.transpose();
        dP.diagonal() += model.k();
    }
    void predict(double gap, int substeps) {
        double h = gap / substeps;
        Vector a1, a2, a3, a4;
        Square b1, b2, b3, b4;
        for (int s = 0; s < substeps; s++) {
            slopes(m, P, a1, b1);
            slopes(m + 0.5 * h * a1, P + 0.5 * h * b1, a2, b2);
            slopes(m + 0.5 * h * a2, P + 0.5 * h * b2, a3, b3);
            slopes(m + h * a3, P + h * b3, a4, b4);
            m += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
            P += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
        }
    }
};

// Ito and Taylor's step of order 1.5, simplified (docs/algorithms.md C4, C5).
struct ItoTaylor : Ckf<Space> {
    using Ckf<Space>::Ckf;
    void predict(double gap, int substeps) {
        double h = gap / substeps, root = std::sqrt(0.2), rate = std::sqrt(4.9e-7);
        Matrix<double, 7, 4> G = Matrix<double, 7, 4>::Zero(), L = G, A, B;
        G(1, 0) = G(3, 1) = G(5, 2) = root;
        G(6, 3) = rate;
        L(0, 0) = L(2, 1) = L(4, 2) = root;
        for (int s = 0; s < substeps; s++) {
            // columns of L = J G at the mean that the step starts from
            L(1, 1) = -m[6] * root;
            L(1, 3) = -m[3] * rate;
            L(3, 0) = m[6] * root;
            L(3, 3) = m[1] * rate;
            A = std::sqrt(h) * (G + 0.5 * h * L);
            B = std::sqrt(h * h * h / 12) * L;
            spread();
            for (int j = 0; j < 14; j++) {
                Vector x = m + X.col(j), f = Space::drift(x), l;
                l << f[1], -x[6] * f[3], f[3], x[6] * f[1], 0, 0, 0;
                F.col(j) = x + h * f + 0.5 * h * h * l;
            }
            m = F.rowwise().mean();
            F.colwise() -= m;
            covariance(F, P);
            P += A.lazyProduct(A.transpose()) + B.lazyProduct(B.transpose());
        }
    }
};
