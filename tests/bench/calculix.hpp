// CalculiX's own contact: its node-to-face spring between a slave node and a flat or bent quadrilateral, from
// the sources of ccx.
#pragma once

#include <array>

namespace bench {

// Linear pressure-overclosure, Coulomb friction; node order: master 1 .. 4, slave.
class CalculixSpring {
public:
  static bool available(); // was this program built with ccx's routines?

  // slip: motion [3] of the slave node along the surface since it came into contact, length; coefficient 0:
  // no friction
  CalculixSpring(const double* slave, const double* master, double area, double stiffness, const double* slip,
                 double coefficient, double shear_stiffness);

  // springforc_n2f and springstiff_n2f
  void run();

  bool slips() const { return state_end_[0] != 0.0 || state_end_[1] != 0.0 || state_end_[2] != 0.0; }
  const double* slave_force() const { return &force_[3 * 4]; } // internal
  // d force / d u; without friction ccx fills the upper triangle only: row <= column
  double stiffness(int row, int column) const {
    return stiffness_[static_cast<std::size_t>(60 * column + row)];
  }
  const double* master_force(int node) const { return &force_[static_cast<std::size_t>(3 * node)]; }

private:
  std::array<double, 30> positions_{}, force_{};
  std::array<double, 40> displacements_{}; // (0:3, 10)
  std::array<double, 8> law_{};            // elcon(0:7)
  std::array<double, 2> area_{};
  std::array<double, 9> state_begin_{}, state_end_{};
  std::array<double, 3600> stiffness_{};
  int unsymmetric_ = 0;
};

} // namespace bench
