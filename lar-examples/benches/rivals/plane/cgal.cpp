// The arrangement of the segments of a file by CGAL's Arrangement_2 with its exact kernel: what it took and what came
// out, as JSON.

#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using Traits = CGAL::Arr_segment_traits_2<CGAL::Exact_predicates_exact_constructions_kernel>;

static long kilobytes(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind(field, 0) == 0) return std::stol(line.substr(field.size()));
    return 0;
}

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    std::ifstream file(argv[1]);
    std::vector<Traits::Curve_2> segments;
    for (double x, y, z, w; file >> x >> y >> z >> w;)
        segments.emplace_back(Traits::Point_2(x, y), Traits::Point_2(z, w));

    // The program itself is in memory before anything is measured.
    const std::vector<Traits::Curve_2> three = {Traits::Curve_2(Traits::Point_2(0, 0), Traits::Point_2(1, 1)),
                                                Traits::Curve_2(Traits::Point_2(0, 1), Traits::Point_2(1, 0)),
                                                Traits::Curve_2(Traits::Point_2(0.5, 0), Traits::Point_2(0.6, 1))};
    CGAL::Arrangement_2<Traits> first;
    CGAL::insert(first, three.begin(), three.end());

    std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
    const long before = kilobytes("VmRSS:");
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    CGAL::Arrangement_2<Traits> arrangement;
    CGAL::insert(arrangement, segments.begin(), segments.end());
    const double cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> wall_seconds = std::chrono::steady_clock::now() - wall;
    const long memory = kilobytes("VmHWM:") - before;

    // Every component is a hole of the face around it.
    size_t components = 0;
    for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face)
        components += std::distance(face->inner_ccbs_begin(), face->inner_ccbs_end());
    std::printf("{\"cpu\": %f, \"wall\": %f, \"memory\": %ld, \"counts\": [%zu, %zu, %zu, %zu]}\n", cpu_seconds,
                wall_seconds.count(), 1024 * memory, size_t(arrangement.number_of_vertices()),
                size_t(arrangement.number_of_edges()), size_t(arrangement.number_of_faces()), components);
}
