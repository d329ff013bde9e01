// SPDX-License-Identifier: BSD-3-Clause
// Contact of two borders of a 2D mesh through ents.h: detection, elements, history. Nothing of FreeFEM is in
// here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ents.hpp>

namespace freefem {

/// Edges of a border. All of them run with the body to their right: segments have their normal to the left,
/// out of it.
struct Border {
  std::vector<int> vertices;       ///< vertex of the mesh that each node of the border is
  std::vector<double> start;       ///< [nodes][2] positions, [L]
  std::vector<std::int64_t> edges; ///< [edges][2] nodes
};

struct Options {
  int coordinate = -1;  ///< 0, 1: surface coordinate s of the height is the first x or y of the master's
                        ///< nodes; -1: as the model says, or xi
  double reach = 0;     ///< [L] nodes farther away are open; 0: the master's longest edge
  double thickness = 1; ///< [L]
  int ends = ENTS_ENDS_REPEATED; ///< smoothed surfaces: another ENTS_ENDS_...
};

struct Forces {
  std::vector<long> row, column; ///< of the entries of K; the same place may come again
  std::vector<double> value;     ///< [F/L]; in rows of temperatures [power/L], [power/temperature]
  double step_factor = 1;        ///< below 1: nothing was added; rejected, cut the step by this factor
  std::string message;           ///< why
};

/// All methods throw std::runtime_error with the library's message. dof = 2 vertex + component; with "heat" in the
/// model 3 vertex + component, and the temperature is the last one.
class BorderContact {
public:
  /// @param model  JSON text, or the name of a file with it
  /// @param vertices  of the whole mesh
  BorderContact(const std::string& model, Border slave, Border master, long vertices, const Options& options);
  BorderContact(const BorderContact&) = delete;
  BorderContact& operator=(const BorderContact&) = delete;

  /// Dofs of the whole mesh.
  long dofs() const { return dofs_; }

  /// @param u, r  numbers of entries that a script gives
  /// @throws what to write, if they are not `dofs`
  void require_sizes(long u, long r) const;

  /// @param u   [dofs] displacements, [L], and temperatures
  /// @param r   [dofs] R is added, [F]; of a temperature: the power that leaves the vertex
  /// @param dt  time of the increment, > 0, where friction heats or depends on the slip rate; else not read
  Forces evaluate(const double* u, double* r, double dt = 0);

  /// What the last `evaluate` found is the begin of the next increment.
  void accept();

  /// The increment is thrown away: the next `evaluate` starts from its begin, as the first one did.
  void reject();

private:
  struct Term {
    long dof;
    double weight;
  };
  /// @return basis of the model's smoothed segment, or ""
  /// @throws what these borders cannot do
  std::string basis_of(const std::string& model) const;
  void make_segments(const std::string& basis, const Options& options);
  void make_tree(const Options& options);
  std::vector<double> positions(const Border& border, const double* u) const;
  std::vector<double> temperatures(const Border& border, const double* u) const;
  /// Values of control points, [points][values], from those of the master's nodes.
  std::vector<double> control_points(std::int32_t values, const std::vector<double>& of_nodes) const;
  long first_dof(int vertex) const { return components_ * vertex; }
  /// Positions and temperatures of slave nodes and master.
  void place(const double* u);
  ents::Result iterate(double dt, const ents_output& out);
  void terms(std::size_t slave, std::size_t local, std::vector<Term>& of) const;
  /// The element of slave node k: residual [dofs] and tangent [dofs][dofs], column by column.
  void add_element(std::size_t k, const double* residual, const double* tangent, double* r, Forces& to) const;

  ents::Model model_;
  Border slave_, master_;
  long components_, dofs_; ///< of a vertex, of the mesh
  double reach_;
  std::vector<double> areas_;
  // The master surface: segments over control points, which are combinations of its nodes (plain facets: the
  // nodes themselves).
  std::vector<std::int64_t> segments_;
  ents::Combination net_;
  std::vector<double> coordinates_, points_, point_temperatures_, slave_temperatures_;
  ents_master_mesh mesh_{};
  ents::Tree tree_;
  // Where slave nodes are and their history: at the begin of the increment, and as of the last evaluation.
  std::vector<std::int64_t> segment_, segment_begin_;
  std::vector<double> xi_, xi_begin_, points_begin_, now_, now_begin_;
  ents::States states_;
};

} // namespace freefem
