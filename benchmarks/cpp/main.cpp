// Hand-written textbook filters in C++ with Eigen: `cpp CONTESTANT WORKLOAD INPUTS`.
#include "continuous.hpp"

static const std::string VERSION = "Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                                   "." + std::to_string(EIGEN_MINOR_VERSION) + ", " + __VERSION__;

template <class Filter, class Model, class Predict>
void run(const Model& model, const Table& rows, size_t steps, size_t every, Predict predict) {
    serve(VERSION, rows.rows(), Told{every, 0, {}}, [&](Told* told) {
        double last = 0;
        for (size_t first = 0; first < rows.rows(); first += steps) {
            Filter f(model);
            for (size_t k = first; k < first + steps; k++) {
                predict(f);
                f.update(rows.row(k));
                if (told) told->next(f.m, f.P);
            }
            last = f.m[0];
        }
        return last;
    });
}

static void smoother(const Table& rows) {
    using Filter = Ckf<Plane>;
    std::vector<Record<Filter>> records(rows.rows());
    serve(VERSION, rows.rows(), Told{10, 0, {}}, [&](Told* told) {
        Filter f{Plane{}};
        for (size_t k = 0; k < records.size(); k++) {
            f.predict(true);
            records[k].ahead_m = f.m;
            records[k].ahead_P = f.P;
            records[k].cross = f.cross;
            f.update(rows.row(k));
            records[k].m = f.m;
            records[k].P = f.P;
        }
        smooth<Filter>(records);
        if (told)
            for (auto& record : records) told->next(record.m, record.P);
        return records[0].m[0];
    });
}

int main(int argc, char** argv) try {
    if (argc != 4) throw std::runtime_error("usage: cpp CONTESTANT WORKLOAD INPUTS");
    const std::string workload = argv[2], inputs = argv[3];
    auto discrete = [](auto& f) { f.predict(); };
    auto csv = [&](const std::string& name) { return read_csv(inputs + "/" + name + ".csv"); };
    if (workload == "W1") run<Ckf<Plane>>(Plane{}, csv("plane"), 1000, 10, discrete);
    else if (workload == "W2") run<Ckf<Plane>>(Plane{}, read_f32(inputs + "/plane_tracks.f32", 2), 100, 100, discrete);
    else if (workload == "W3a") run<MomentOde>(Space{}, csv("space"), 30, 1, [](auto& f) { f.predict(4, 16); });
    else if (workload == "W3b") run<Ckf<Space>>(Space{}, csv("space"), 30, 1, discrete);
    else if (workload == "W4") smoother(csv("plane"));
    else if (workload == "P1") run<ItoTaylor>(Space{}, csv("space_fast"), 200, 10, [](auto& f) { f.predict(1, 8); });
    else if (workload == "P2") run<Ckf<Space>>(Space{}, csv("space_still"), 200, 200, [](auto&) {});
    else if (workload.rfind("W5-", 0) == 0) {
        Circle circle(csv("circle_" + workload.substr(3) + "_prior"));
        Table rows = csv("circle_" + workload.substr(3));
        run<Ckf<Circle>>(circle, rows, rows.rows(), rows.rows(), discrete);
    } else std::printf("lacks\tit has no filter for this workload\n");
} catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
