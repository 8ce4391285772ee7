// CGAL's refinement (Delaunay_mesh_2) of the lines that `refine_race` hands over: triangles and seconds.
//
//     c++ -O3 -DNDEBUG -o cgal_refine crates/lineart/examples/cgal_refine.cpp -lgmp -lmpfr
//
// Standard input, any number of times: numbers of points and of lines and the longest edge; points as `x y`; lines as two
// numbers of points each. For each, one line of output: number of triangles, seconds from the first point to the last
// triangle. The sine of no angle is below the square root of an eighth (20.7°), but for small angles between lines.

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <cstddef>
#include <iostream>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Face = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
// The lines meet in points only.
using Tag = CGAL::No_constraint_intersection_requiring_constructions_tag;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Tag>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

int main() {
    std::size_t count, lines;
    double longest;
    std::cout.precision(9);
    while (std::cin >> count >> lines >> longest) {
        std::vector<Kernel::Point_2> points;
        for (std::size_t i = 0; i < count; ++i) {
            double x, y;
            std::cin >> x >> y;
            points.emplace_back(x, y);
        }
        std::vector<std::pair<std::size_t, std::size_t>> ends(lines);
        for (auto& [from, to] : ends) std::cin >> from >> to;
        if (!std::cin) {
            std::cerr << "cgal_refine: the input ends too early\n";
            return 1;
        }
        const auto start = std::chrono::steady_clock::now();
        Triangulation triangulation;
        triangulation.insert_constraints(points.begin(), points.end(), ends.begin(), ends.end());
        CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation, Criteria(0.125, longest));
        mesher.refine_mesh();
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        std::size_t inside = 0;
        for (auto face : triangulation.finite_face_handles()) inside += face->is_in_domain();
        std::cout << inside << ' ' << time.count() << std::endl;
    }
}
