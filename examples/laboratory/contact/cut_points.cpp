// SPDX-License-Identifier: BSD-3-Clause
#include "cut_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Dense>

#include "polygon.hpp"
#include "toolbox/error.hpp"

namespace host {
namespace {

/// Corners that are as close, relative to the face, are one; pieces that are as narrow are none.
constexpr double same_place = 1e-10;

// ---- in the plane ----------------------------------------------------------------------------------------

struct Border {
  Eigen::Vector2d point, normal;
};

/// The ends of the segments, those in one place once with their mean normal.
std::vector<Border> borders_of(const SegmentCorners& master) {
  std::vector<Border> ends;
  double size = 0;
  for (std::size_t i = 0; i < master.points.size() / 2; ++i) {
    ends.push_back({{master.points[2 * i], master.points[2 * i + 1]},
                    {master.normals[2 * i], master.normals[2 * i + 1]}});
    size = std::max(size, (ends.back().point - ends.front().point).norm());
  }
  std::sort(ends.begin(), ends.end(), [](const Border& a, const Border& b) {
    return a.point[0] != b.point[0] ? a.point[0] < b.point[0] : a.point[1] < b.point[1];
  });
  std::vector<Border> borders;
  for (const Border& end : ends) {
    bool known = false;
    for (auto other = borders.rbegin(); other != borders.rend() && !known; ++other) {
      if (end.point[0] - other->point[0] > same_place * size) break;
      known = (end.point - other->point).norm() <= same_place * size;
      if (known) other->normal += end.normal;
    }
    if (!known) borders.push_back(end);
  }
  return borders;
}

/// Natural coordinates at which a line is cut, its ends included, ascending.
std::vector<double> cuts_of_line(const Eigen::Vector2d& first, const Eigen::Vector2d& last,
                                 const std::vector<Border>& borders) {
  std::vector<double> cuts{-1, 1};
  const Eigen::Vector2d along = 0.5 * (last - first), middle = 0.5 * (first + last);
  const Eigen::Vector2d outward(-along[1], along[0]);
  for (const Border& border : borders) {
    if (!(border.normal.dot(outward) < 0)) continue; // a surface that faces away
    // middle + xi along = point + t normal
    Eigen::Matrix2d matrix;
    matrix << along, -border.normal;
    const double xi = matrix.partialPivLu().solve(border.point - middle)[0];
    if (std::abs(xi) < 1) cuts.push_back(xi);
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> apart{-1};
  for (const double xi : cuts)
    if (xi - apart.back() > same_place) apart.push_back(xi);
  if (apart.size() == 1 || 1 - apart.back() > same_place) apart.push_back(1);
  apart.back() = 1;
  return apart;
}

// ---- in space --------------------------------------------------------------------------------------------

/// The mean plane of a face, and the face in it.
class FacePlane {
public:
  explicit FacePlane(const std::vector<Eigen::Vector3d>& corners) {
    const std::size_t n = corners.size();
    origin_ =
        std::accumulate(corners.begin(), corners.end(), Eigen::Vector3d(0, 0, 0)) / static_cast<double>(n);
    normal_ = n == 3 ? (corners[1] - corners[0]).cross(corners[2] - corners[0])
                     : (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    normal_.normalize();
    first_ = corners[1] - corners[0];
    first_ = (first_ - first_.dot(normal_) * normal_).normalized();
    second_ = normal_.cross(first_);
    for (const Eigen::Vector3d& corner : corners) {
      face_.push_back(project(corner));
      size_ = std::max(size_, face_.back().norm());
    }
  }

  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {first_.dot(point - origin_), second_.dot(point - origin_)};
  }
  double distance(const Eigen::Vector3d& point) const { return normal_.dot(point - origin_); }
  const Polygon& face() const { return face_; }
  double size() const { return size_; } ///< largest distance of a corner from the middle

  /// Shape functions, and the area of the plane per natural coordinates.
  struct Values {
    Eigen::VectorXd shape;
    Eigen::MatrixXd derivatives; ///< [nodes][2]
    double jacobian = 0;
  };
  Values at(const Eigen::Vector2d& place) const {
    Values values;
    Eigen::Vector2d xi(0, 0);
    Eigen::Matrix<double, 2, Eigen::Dynamic> nodes(2, static_cast<Eigen::Index>(face_.size()));
    for (std::size_t a = 0; a < face_.size(); ++a) nodes.col(static_cast<Eigen::Index>(a)) = face_[a];
    for (int iteration = 0; iteration < 50; ++iteration) {
      if (face_.size() == 3) {
        const auto point = detail::linear<2>({xi[0], xi[1], 0}, 1);
        values.shape = point.values, values.derivatives = point.derivatives;
      } else {
        const auto point = detail::multilinear<4, 2>({xi[0], xi[1], 0}, 1);
        values.shape = point.values, values.derivatives = point.derivatives;
      }
      const Eigen::Matrix2d map = nodes * values.derivatives;
      values.jacobian = map.determinant();
      const Eigen::Vector2d step = map.inverse() * (place - nodes * values.shape);
      if (step.norm() < 1e-15 || (iteration > 5 && step.norm() < 1e-14)) return values;
      xi += step;
    }
    throw JobError("a slave face cannot be cut: its natural coordinates are not found; is it turned inside "
                   "out?");
  }

private:
  Eigen::Vector3d origin_, normal_, first_, second_;
  Polygon face_;
  double size_ = 0;
};

/// A segment, and the box round it.
struct Segment {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d low, high;
};

/// A quadrilateral with two corners in one place, or next to each other as the library gives the corners of
/// such a segment, is a triangle.
void drop_collapsed_side(std::vector<Eigen::Vector3d>& corners) {
  const double size = (corners[2] - corners[0]).norm() + (corners.back() - corners[1]).norm();
  for (std::size_t a = 0; a < corners.size() && corners.size() == 4; ++a)
    if ((corners[(a + 1) % 4] - corners[a]).norm() <= 1e-5 * size)
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(a));
}

std::vector<Segment> segments_of(const SegmentCorners& master) {
  std::vector<Segment> segments(master.points.size() / (3 * master.corners));
  const double* point = master.points.data();
  for (Segment& segment : segments) {
    for (std::size_t a = 0; a < master.corners; ++a, point += 3)
      segment.corners.emplace_back(point[0], point[1], point[2]);
    drop_collapsed_side(segment.corners);
    segment.low = segment.high = segment.corners.front();
    for (const Eigen::Vector3d& corner : segment.corners)
      segment.low = segment.low.cwiseMin(corner), segment.high = segment.high.cwiseMax(corner);
  }
  return segments;
}

/// A segment's convex parts in the plane of a face, empty if it faces away.
std::vector<Polygon> windows_of(const FacePlane& plane, const Segment& segment) {
  Polygon window;
  for (auto corner = segment.corners.rbegin(); corner != segment.corners.rend(); ++corner)
    window.push_back(plane.project(*corner)); // the surfaces face each other: their turns are opposite
  if (!(area_of(window) > 0)) return {};
  if (is_convex(window)) return {window};
  std::vector<Polygon> parts; // a warped or sheared quadrilateral
  for (const std::size_t i : {2u, 3u})
    if (Polygon part{window[0], window[i - 1], window[i]}; area_of(part) > 0) parts.push_back(part);
  return parts;
}

/// The pieces of a face: what it has in common with each segment, and the rest.
std::vector<Polygon> pieces_of(const FacePlane& plane, const std::vector<const Segment*>& near) {
  const double tolerance = same_place * plane.size();
  std::vector<std::pair<double, Polygon>> windows;
  for (const Segment* segment : near)
    for (Polygon& window : windows_of(plane, *segment))
      windows.emplace_back(std::abs(plane.distance(segment->corners.front())), std::move(window));
  // The nearest first: it has its piece to itself where surfaces lie above each other.
  std::stable_sort(windows.begin(), windows.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Polygon> common, divided, rest{plane.face()};
  double sum = 0, rest_area = 0;
  for (const auto& [distance, window] : windows) {
    Polygon piece = intersection(plane.face(), window, tolerance);
    if (piece.empty()) continue;
    std::vector<Polygon> outside;
    for (const Polygon& part : rest) {
      if (Polygon inside = intersection(part, window, tolerance); !inside.empty()) divided.push_back(inside);
      append_difference(part, window, tolerance, outside);
    }
    rest = std::move(outside);
    sum += area_of(piece);
    common.push_back(std::move(piece));
  }
  for (const Polygon& part : rest) rest_area += area_of(part);
  // Where segments overlap, each keeps what those before it have left.
  const double total = area_of(plane.face());
  std::vector<Polygon> pieces = std::abs(sum + rest_area - total) <= 1e-9 * total ? common : divided;
  pieces.insert(pieces.end(), rest.begin(), rest.end());
  std::erase_if(pieces, [&](const Polygon& piece) { return area_of(piece) <= 1e-12 * total; });
  return pieces;
}

/// Reference area per natural coordinates at a point of a face.
double reference_jacobian(const Mesh& mesh, const Face& face, const FacePlane::Values& values) {
  Eigen::Vector3d first(0, 0, 0), second(0, 0, 0);
  for (int a = 0; a < face.count; ++a) {
    const Eigen::Vector3d node(mesh.node(face.nodes[static_cast<std::size_t>(a)]).data());
    first += values.derivatives(a, 0) * node, second += values.derivatives(a, 1) * node;
  }
  return first.cross(second).norm();
}

void cut_in_space(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<double>& positions,
                  const SegmentCorners& master, int per_direction, SlavePoints& points) {
  const std::vector<Segment> segments = segments_of(master);
  for (const Face& face : faces) {
    const auto count = static_cast<std::size_t>(face.count);
    std::vector<Eigen::Vector3d> corners;
    for (std::size_t a = 0; a < count; ++a)
      corners.emplace_back(positions.data() + 3 * static_cast<std::size_t>(face.nodes[a]));
    const FacePlane plane(corners);
    if (!(area_of(plane.face()) > 0) || !is_convex(plane.face()))
      throw JobError("a slave face cannot be cut: it is not convex");
    Eigen::Vector3d low = corners.front(), high = low;
    for (const Eigen::Vector3d& corner : corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant((high - low).norm());
    std::vector<const Segment*> near;
    for (const Segment& segment : segments)
      if ((segment.low.array() <= (high + margin).array()).all() &&
          (segment.high.array() >= (low - margin).array()).all())
        near.push_back(&segment);
    std::vector<PlanePoint> rule;
    for (const Polygon& piece : pieces_of(plane, near)) append_quadrature(piece, per_direction, rule);
    for (const PlanePoint& point : rule) {
      const FacePlane::Values values = plane.at(point.place);
      points.areas.push_back(point.weight * reference_jacobian(mesh, face, values) / values.jacobian);
      points.nodes.insert(points.nodes.end(), face.nodes.begin(), face.nodes.begin() + face.count);
      points.weights.insert(points.weights.end(), values.shape.begin(), values.shape.end());
      if (count < points.nodes_per_point) // a triangle among quadrilaterals
        points.nodes.push_back(face.nodes[count - 1]), points.weights.push_back(0);
    }
  }
}

void cut_in_plane(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<double>& positions,
                  const SegmentCorners& master, int per_direction, const SlaveGeometry& geometry,
                  SlavePoints& points) {
  const std::vector<Border> borders = borders_of(master);
  const auto rule = gauss_legendre(per_direction);
  for (const Face& face : faces) {
    const auto now = [&](std::size_t a) {
      return Eigen::Vector2d(positions.data() + 2 * static_cast<std::size_t>(face.nodes[a]));
    };
    const auto before = [&](std::size_t a) { return Eigen::Vector2d(mesh.node(face.nodes[a]).data()); };
    const double length = (before(1) - before(0)).norm();
    const std::vector<double> cuts = cuts_of_line(now(0), now(1), borders);
    for (std::size_t i = 1; i < cuts.size(); ++i)
      for (const auto& [s, weight] : rule) {
        const double half = 0.5 * (cuts[i] - cuts[i - 1]), middle = 0.5 * (cuts[i] + cuts[i - 1]);
        const double slope = 0.5 * (before(1)[0] - before(0)[0]);
        const double radius = 0.5 * (before(0)[0] + before(1)[0]) + slope * (middle + half * s);
        // One point of a ring: its centroid, because shape function times radius is of degree 2.
        const bool ring = per_direction == 1 && geometry.axisymmetric && radius > 0;
        const double xi = middle + half * (ring ? slope * half / (3 * radius) : s);
        const double first = 0.5 * (1 - xi), second = 0.5 * (1 + xi);
        points.areas.push_back(0.5 * length * half * weight *
                               (geometry.axisymmetric ? 2 * std::numbers::pi * radius : geometry.thickness));
        points.nodes.insert(points.nodes.end(), face.nodes.begin(), face.nodes.begin() + 2);
        points.weights.insert(points.weights.end(), {first, second});
      }
  }
}

} // namespace

SlavePoints cut_points(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<double>& positions,
                       const SegmentCorners& master, int per_direction, const SlaveGeometry& geometry) {
  SlavePoints points;
  points.nodes_per_point = count_of_nodes(faces);
  if (mesh.dimension == 2)
    cut_in_plane(mesh, faces, positions, master, per_direction, geometry, points);
  else
    cut_in_space(mesh, faces, positions, master, per_direction, points);
  return points;
}

} // namespace host
