// The workloads' models, as in benchmarks/python/problems.py.
#pragma once
#include "contest.hpp"
#include <Eigen/Dense>
#include <cmath>

using Eigen::Matrix;

// A turn in the plane; range and bearing.
struct Plane {
    static constexpr int N = 5, D = 2;
    int n = N, d = D;
    template <class X, class O> void step(const X& x, O&& out) const {
        double w = x[4], s = std::sin(w), c = std::cos(w), a = s / w, b = (1 - c) / w;
        out[0] = x[0] + a * x[1] - b * x[3];
        out[1] = c * x[1] - s * x[3];
        out[2] = x[2] + b * x[1] + a * x[3];
        out[3] = s * x[1] + c * x[3];
        out[4] = w;
    }
    template <class X, class O> void see(const X& x, O&& z) const {
        z[0] = std::sqrt(x[0] * x[0] + x[2] * x[2]);
        z[1] = std::atan2(x[2], x[0]);
    }
    Matrix<double, N, N> Q() const {
        Matrix<double, N, N> q = Matrix<double, N, N>::Zero();
        for (int i : {0, 2}) {
            q(i, i) = 0.1 / 3;
            q(i, i + 1) = q(i + 1, i) = 0.05;
            q(i + 1, i + 1) = 0.1;
        }
        q(4, 4) = 1e-7;
        return q;
    }
    Matrix<double, D, 1> r() const { return {100.0, 1e-5}; }
    Matrix<double, N, 1> mean() const {
        Matrix<double, N, 1> m;
        m << 20000, 300, 20000, 0, -3 * M_PI / 180;
        return m;
    }
    Matrix<double, N, 1> variances() const {
        Matrix<double, N, 1> v;
        v << 100, 10, 100, 10, 1e-5;
        return v;
    }
};

// A turn in space; range, azimuth and elevation.
struct Space {
    static constexpr int N = 7, D = 3;
    using Vector = Matrix<double, N, 1>;
    int n = N, d = D;
    double gap = 4;
    template <class X> static Vector drift(const X& x) {
        Vector f;
        f << x[1], -x[6] * x[3], x[3], x[6] * x[1], x[5], 0, 0;
        return f;
    }
    template <class X, class O> void step(const X& from, O&& out) const {
        double x[N], k1[N], k2[N], k3[N], k4[N], at[N], h = gap / 16;
        auto slope = [](const double* x, double* k) {
            k[0] = x[1], k[1] = -x[6] * x[3], k[2] = x[3], k[3] = x[6] * x[1], k[4] = x[5], k[5] = k[6] = 0;
        };
        auto ahead = [&](double by, const double* k) {
            for (int i = 0; i < N; i++) at[i] = x[i] + by * k[i];
        };
        for (int i = 0; i < N; i++) x[i] = from[i];
        for (int s = 0; s < 16; s++) {
            slope(x, k1), ahead(0.5 * h, k1);
            slope(at, k2), ahead(0.5 * h, k2);
            slope(at, k3), ahead(h, k3);
            slope(at, k4);
            for (int i = 0; i < N; i++) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        }
        for (int i = 0; i < N; i++) out[i] = x[i];
    }
    template <class X, class O> void see(const X& x, O&& z) const {
        double ground = std::sqrt(x[0] * x[0] + x[2] * x[2]);
        z[0] = std::sqrt(ground * ground + x[4] * x[4]);
        z[1] = std::atan2(x[2], x[0]);
        z[2] = std::atan2(x[4], ground);
    }
    // G G' of the continuous noise, all on the diagonal
    Vector k() const {
        Vector k;
        k << 0, 0.2, 0, 0.2, 0, 0.2, 4.9e-7;
        return k;
    }
    Matrix<double, N, N> Q() const {
        Matrix<double, N, N> q = Matrix<double, N, N>::Zero();
        for (int i : {0, 2, 4}) {
            q(i, i) = 0.2 * gap * gap * gap / 3;
            q(i, i + 1) = q(i + 1, i) = 0.1 * gap * gap;
            q(i + 1, i + 1) = 0.2 * gap;
        }
        q(6, 6) = 4.9e-7 * gap;
        return q;
    }
    Matrix<double, D, 1> r() const {
        double angle = 0.1 * M_PI / 180;
        return {2500.0, angle * angle, angle * angle};
    }
    Vector mean() const {
        Vector m;
        m << 1000, 0, 2650, 150, 200, 0, 6 * M_PI / 180;
        return m;
    }
    Vector variances() const {
        Vector v;
        v << 100, 10, 100, 10, 100, 10, 1e-4;
        return v;
    }
};

// Lorenz-96; every other component.
struct Circle {
    static constexpr int N = Eigen::Dynamic, D = Eigen::Dynamic;
    using Vector = Eigen::VectorXd;
    Vector begin;
    int n, d;
    explicit Circle(const Table& prior)
        : begin(Eigen::Map<const Vector>(prior.values.data(), prior.values.size())), n(begin.size()), d(n / 2) {}
    void drift(const double* x, double* f) const {
        auto at = [&](int i, double after, double before, double second) { f[i] = (after - second) * before - x[i] + 8; };
        at(0, x[1], x[n - 1], x[n - 2]);
        at(1, x[2], x[0], x[n - 1]);
        for (int i = 2; i < n - 1; i++) at(i, x[i + 1], x[i - 1], x[i - 2]);
        at(n - 1, x[0], x[n - 2], x[n - 3]);
    }
    template <class X, class O> void step(const X& x, O&& out) const {
        constexpr double h = 0.05, weights[] = {1, 2, 2, 1}, ahead[] = {0.5, 0.5, 1, 0};
        double k[256], at[256];
        for (int i = 0; i < n; i++) out[i] = at[i] = x[i];
        for (int stage = 0; stage < 4; stage++) {
            drift(at, k);
            for (int i = 0; i < n; i++) {
                out[i] += weights[stage] * h / 6 * k[i];
                at[i] = x[i] + ahead[stage] * h * k[i];
            }
        }
    }
    template <class X, class O> void see(const X& x, O&& z) const {
        for (int i = 0; i < d; i++) z[i] = x[2 * i];
    }
    Eigen::MatrixXd Q() const { return 0.05 * Eigen::MatrixXd::Identity(n, n); }
    Vector r() const { return Vector::Ones(d); }
    Vector mean() const { return begin; }
    Vector variances() const { return Vector::Ones(n); }
};
