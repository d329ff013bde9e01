// SPDX-License-Identifier: BSD-3-Clause
#include "point_counts.hpp"

#include <algorithm>
#include <cmath>

#include "facet_tree.hpp"

namespace ents_deck {
namespace {

using std::string;

constexpr std::size_t most_quadratic_points = 20000; ///< each has a stiffness of 60 x 60 in ccx's adapter

bool is_linear(Shape shape) { return node_count(shape) == corner_count(shape); }

const Point& corner(const Mesh& mesh, const Face& face, int i) {
  return mesh.nodes[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])].x;
}

/// Master faces along an edge of the slave face: its length over the extent of `master` along it, the largest of all
/// edges.
double faces_along(const Mesh& mesh, const Face& slave, const Face& master) {
  const int corners = corner_count(slave.shape);
  double most = 0;
  for (int i = 0; i < corners; ++i) {
    const Point edge = minus(corner(mesh, slave, (i + 1) % corners), corner(mesh, slave, i));
    double low = INFINITY, high = -INFINITY;
    for (int j = 0; j < corner_count(master.shape); ++j) {
      const double along = dot(corner(mesh, master, j), edge);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    if (high > low) most = std::max(most, dot(edge, edge) / (high - low));
  }
  return most;
}

/// Of the master faces nearest to the slave face: looked for from its middle, and from beside each corner.
double finest_master(const Mesh& mesh, const Face& slave, const std::vector<Face>& masters,
                     const FacetTree& tree) {
  const Point normal = face_normal(mesh, slave), middle = face_middle(mesh, slave);
  double most = 0;
  for (int i = -1; i < corner_count(slave.shape); ++i) {
    Point x = middle;
    if (i >= 0)
      for (std::size_t j = 0; j < 3; ++j) x[j] += 0.9 * (corner(mesh, slave, i)[j] - middle[j]);
    const FacetTree::Closest under = tree.closest(x, normal);
    if (under.face >= 0)
      most = std::max(most, faces_along(mesh, slave, masters[static_cast<std::size_t>(under.face)]));
  }
  return most;
}

/// What a linear face needs over so many master faces. Three points are within 0.06 % of a uniform pressure over up to
/// two, and wrong by 1.3 % over 2.5, by 59 % over four; one more than there are faces holds everywhere.
int over_finer(int least, double faces) {
  return faces > 2 + 1e-6 ? std::max(least, static_cast<int>(std::ceil(faces - 1e-6)) + 1) : least;
}

constexpr double most_over_quadratic =
    3.5; ///< 0.8 % with 7 points; over four 12 %, 4 % with 10, which is no remedy

/// Slave faces over much finer faces of the master.
struct Finer {
  int most = 0;     ///< points per direction that one of them wants
  int few = 0;      ///< faces with fewer points than they want
  int more = 0;     ///< faces that have more than the others
  int hopeless = 0; ///< quadratic faces over so many that no number of points helps

  string remark(const Contact& contact) const {
    const int faces = std::max({few, more, hopeless});
    if (faces == 0) return {};
    const string points = "up to " + std::to_string(most) + " points per direction";
    return std::to_string(faces) + " slave faces lie over much finer faces of the master: " +
           (hopeless > 0 ? "stresses are wrong by 4 to 40 % there"
            : few > 0    ? "a uniform pressure wants " + points + ", and stresses are wrong with fewer"
                         : "they have " + points) +
           "; the slave is best the finer surface (--pair " + contact.pair.master + "," + contact.pair.slave +
           ")";
  }
};

/// The number for faces that do not lie over finer ones.
int usual_count(const Contact& contact, const Options& options, std::vector<string>& remarks) {
  const Shape shape = contact.slave.faces[0].shape;
  int suggested = corner_count(shape) == 2 ? 8 : is_linear(shape) ? 3 : 7;
  const auto total = [&] {
    return static_cast<std::size_t>(suggested * suggested) * contact.slave.faces.size();
  };
  if (!options.points && suggested == 7 && total() > most_quadratic_points) {
    while (suggested > 3 && total() > most_quadratic_points) suggested -= 2;
    remarks.push_back(std::to_string(suggested) + " points per direction in " +
                      std::to_string(contact.slave.faces.size()) +
                      " quadratic faces: stresses where meshes do not match are exact to " +
                      (suggested == 5 ? "1.5 %" : "7.5 %") + " (7: 0.3 %, with more elements; --points)");
  }
  if (options.points.value_or(suggested) < 2)
    remarks.push_back((*options.points == 0 ? string("an element per node") : string("one point in a face")) +
                      " does not carry a uniform pressure: stresses were wrong by " +
                      (is_linear(shape) ? "6 to 54 % where linear meshes do not match"
                                        : "13 to 140 % on quadratic faces, matching ones included") +
                      "; --points " + std::to_string(suggested) + " keeps them within " +
                      (is_linear(shape) ? "0.5 %" : "1 %"));
  return suggested;
}

} // namespace

std::vector<int> point_counts(const Mesh& mesh, const Contact& contact, const Options& options,
                              std::vector<string>& remarks) {
  const std::vector<Face>& faces = contact.slave.faces;
  if (faces.empty()) {
    if (options.points && *options.points > 0)
      throw Error("--points: the slave '" + contact.pair.slave + "' is of nodes alone");
    return {};
  }
  const int usual = usual_count(contact, options, remarks);
  if (options.points == 0) return {};
  const FacetTree tree(mesh, contact.master.faces);
  std::vector<int> counts;
  Finer finer;
  for (const Face& face : faces) {
    const double over = finest_master(mesh, face, contact.master.faces, tree);
    const int wanted = is_linear(face.shape) ? over_finer(usual, over) : usual;
    counts.push_back(options.points.value_or(std::min(wanted, most_points)));
    finer.most = std::max(finer.most, wanted);
    finer.few += counts.back() < wanted && counts.back() >= 2; // fewer have a remark of their own
    finer.more += counts.back() > usual && !options.points;
    finer.hopeless += !is_linear(face.shape) && over > most_over_quadratic + 1e-6;
  }
  if (const string remark = finer.remark(contact); !remark.empty()) remarks.push_back(remark);
  return counts;
}

} // namespace ents_deck
