// The segment bases written a second time, independently of core: Lagrange products, area coordinates,
// Hermite form (Catmull-Rom) and the Cox-de Boor recursion (B-spline), with the node order that
// golden/README.md documents.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace mechanics {

enum class Family { linear, quadratic, serendipity, catmull_rom, bspline, bernstein };

struct Basis {
  std::string name;
  Family family;
  int dimension;                            // d
  bool simplex;                             // xi >= 0, sum xi <= 1 instead of -1 .. 1 per direction
  std::vector<std::array<double, 2>> nodes; // natural coordinates; of the smoothed bases: of their grid

  int node_count() const { return static_cast<int>(nodes.size()); }
  int parameters() const { return dimension - 1; }
  int dofs() const { return dimension * (node_count() + 1); }
};

// Those of meshes of nodes
const std::vector<Basis>& bases();
std::vector<std::string> basis_names();
// And bezier15, the patches of smoothed triangles: control points, without golden vectors
const std::vector<Basis>& all_bases();
std::vector<std::string> all_basis_names();
const Basis& basis_named(const std::string& name); // one of all_bases()

// Shape functions at xi, and with them their first derivatives.
std::vector<double> shape_values(const Basis& basis, const double* xi);
struct Shape {
  std::vector<double> value, d1, d2;
};
Shape shape_functions(const Basis& basis, const double* xi);

// Is xi, from a sweep that knows it to 3e-7, on the border of the segment or beyond?
bool is_on_border(const Basis& basis, const std::array<double, 2>& xi);

} // namespace mechanics
