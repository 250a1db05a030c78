// What a contestant says to the runner; the same as in benchmarks/protocol.
#pragma once
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

struct Table {
    size_t columns = 0;
    std::vector<double> values;
    size_t rows() const { return values.size() / columns; }
    const double* row(size_t k) const { return values.data() + k * columns; }
};

inline Table read_csv(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    Table table;
    std::string line, cell;
    std::getline(file, line);
    for (std::stringstream cells(line); std::getline(cells, cell, ',');) table.columns++;
    while (std::getline(file, line))
        for (std::stringstream cells(line); std::getline(cells, cell, ',');) table.values.push_back(std::stod(cell));
    return table;
}

inline Table read_f32(const std::string& path, size_t columns) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path);
    Table table;
    table.columns = columns;
    for (float x; file.read(reinterpret_cast<char*>(&x), sizeof x);) table.values.push_back(x);
    return table;
}

// Means, then variances, of every `every`-th row.
struct Told {
    size_t every, seen = 0;
    std::vector<double> numbers;
    template <class Mean, class Cov> void next(const Mean& mean, const Cov& cov) {
        if (++seen % every) return;
        for (long i = 0; i < mean.size(); i++) numbers.push_back(mean[i]);
        for (long i = 0; i < mean.size(); i++) numbers.push_back(cov(i, i));
    }
};

// `run` does the workload once, and tells its rows if it is given someone to tell.
inline void serve(const std::string& version, size_t steps, Told told, const std::function<double(Told*)>& run) {
    run(&told);
    std::printf("version\t%s\nsteps\t%zu\nresult\t", version.c_str(), steps);
    for (size_t i = 0; i < told.numbers.size(); i++) std::printf("%s%.17g", i ? " " : "", told.numbers[i]);
    std::printf("\nready\t\n");
    std::fflush(stdout);
    auto now = [](clockid_t id) {
        timespec t;
        clock_gettime(id, &t);
        return t.tv_sec * 1000000000ll + t.tv_nsec;
    };
    static volatile double kept;
    (void)kept;
    for (std::string line; std::getline(std::cin, line);) {
        long long wall = now(CLOCK_MONOTONIC), cpu = now(CLOCK_THREAD_CPUTIME_ID);
        kept = run(nullptr);
        cpu = now(CLOCK_THREAD_CPUTIME_ID) - cpu;
        std::printf("%lld %lld\n", cpu, now(CLOCK_MONOTONIC) - wall);
        std::fflush(stdout);
    }
}
