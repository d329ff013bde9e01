#include "heights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mechanics {

using nlohmann::json;

namespace {

// Beside the samples: c_-1 and c_n of a clamped map, then its edge samples
constexpr int beyond = 2;

// Gaussian elimination with column pivots
std::vector<double> solve(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

// Coefficients of the cubic B-spline through f: (c_{i-1} + 4 c_i + c_{i+1}) / 6 = f_i. Periodic: as many as
// f. Clamped: `beyond` more at either end; c_-1 and c_n are unknowns of the system, and so that the first two
// cells are one cubic, and the last two, the fourth difference vanishes there (of fewer samples: the third,
// the second).
std::vector<double> spline_coefficients(const std::vector<double>& f, bool periodic) {
  const std::size_t n = f.size(), unknowns = periodic ? n : n + 2;
  std::vector<std::vector<double>> matrix(unknowns, std::vector<double>(unknowns, 0.0));
  std::vector<double> right(unknowns, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      matrix[i][periodic ? (i + k + n - 1) % n : i + k] += (k == 1 ? 4.0 : 1.0) / 6.0;
    right[i] = f[i];
  }
  if (periodic) return solve(matrix, right);
  const std::vector<double> difference = n == 2   ? std::vector<double>{1, -2, 1}
                                         : n == 3 ? std::vector<double>{1, -3, 3, -1}
                                                  : std::vector<double>{1, -4, 6, -4, 1};
  for (std::size_t k = 0; k < difference.size(); ++k) {
    matrix[n][k] = difference[k];
    matrix[n + 1][unknowns - difference.size() + k] = difference[k];
  }
  std::vector<double> c = solve(matrix, right);
  c.insert(c.begin(), beyond - 1, f.front());
  c.insert(c.end(), beyond - 1, f.back());
  return c;
}

// Place of coefficient i among those of spline_coefficients(), for n samples
std::size_t place(long i, int n, bool periodic) {
  if (periodic) return static_cast<std::size_t>(((i % n) + n) % n);
  return static_cast<std::size_t>(std::clamp<long>(i, -beyond, n - 1 + beyond) + beyond);
}

json numbers(Random& random, int count, double bound) {
  json out = json::array();
  for (int i = 0; i < count; ++i) out.push_back(random.uniform(-bound, bound));
  return out;
}

json table(Random& random, int rows, int columns, double bound) {
  json out = json::array();
  for (int i = 0; i < rows; ++i) out.push_back(numbers(random, columns, bound));
  return out;
}

// Every number of an array, whatever its nesting, times factor
json times(const json& value, double factor) {
  if (value.is_number()) return value.get<double>() * factor;
  json out = json::array();
  for (const json& entry : value) out.push_back(times(entry, factor));
  return out;
}

} // namespace

Height::Height(const json& text, int parameters) : parameters_(parameters) {
  if (text.is_null()) return;
  const std::string type = text.at("type");
  if (type == "constant") {
    kind_ = Kind::constant;
    value_ = text.at("value");
  } else if (type == "sine") {
    kind_ = Kind::sine;
    value_ = text.at("amplitude");
    vector_ = text.at("wave_vector").get<std::vector<double>>();
    phase_ = text.value("phase", 0.0);
  } else if (type == "polynomial") {
    kind_ = Kind::polynomial;
    for (const json& row : text.at("coefficients"))
      table_.push_back(row.is_array() ? row.get<std::vector<double>>()
                                      : std::vector<double>{row.get<double>()});
  } else if (type == "gaussian") {
    kind_ = Kind::gaussian;
    value_ = text.at("amplitude");
    vector_ = text.at("center").get<std::vector<double>>();
    width_ = text.at("width");
  } else if (type == "map") {
    kind_ = Kind::map;
    periodic_ = text.at("boundary") == "periodic";
    if (parameters == 1)
      table_ = {text.at("values").get<std::vector<double>>()};
    else
      table_ = text.at("values").get<std::vector<std::vector<double>>>();
    count_ = {static_cast<int>(table_[0].size()), static_cast<int>(table_.size())};
    for (auto& row : table_) row = spline_coefficients(row, periodic_);
    if (parameters == 2) {
      std::vector<std::vector<double>> columns;
      for (std::size_t i = 0; i < table_[0].size(); ++i) {
        std::vector<double> column;
        for (const auto& row : table_) column.push_back(row[i]);
        columns.push_back(spline_coefficients(column, periodic_));
      }
      table_.assign(columns[0].size(), {});
      for (const auto& column : columns)
        for (std::size_t j = 0; j < column.size(); ++j) table_[j].push_back(column[j]);
    }
    const auto size = text.at("size").get<std::vector<double>>();
    origin_ = text.value("origin", std::vector<double>(2, 0.0));
    for (std::size_t a = 0; a < size.size(); ++a)
      spacing_.push_back(size[a] / (periodic_ ? count_[a] : count_[a] - 1));
  } else if (type == "thread") {
    kind_ = Kind::thread;
    periodic_ = true;
    const double pitch = text.at("pitch"), crest = text.at("crest"), root = text.at("root");
    const double degree = std::numbers::pi / 180.0;
    const double rising = std::tan(text.at("flank_angles")[0].get<double>() * degree);
    const double falling = std::tan(text.at("flank_angles")[1].get<double>() * degree);
    const int n = static_cast<int>(std::ceil(2.0 * pitch / text.value("rounding", pitch / 16.0)));
    // ridge from one foot to the other, seen from its crest; heights above the root
    const double depth = (pitch - crest - root) / (rising + falling);
    const double pitch_line = depth - (0.5 * pitch - crest) / (rising + falling);
    table_.resize(1);
    for (int i = 0; i < n; ++i) {
      const double x = pitch * (i <= n / 2 ? i : i - n) / n; // from the nearest crest, or nearly
      double highest = 0.0;
      for (const double from : {x - pitch, x, x + pitch}) {
        const double beyond = std::max(std::fabs(from) - 0.5 * crest, 0.0);
        highest = std::max(highest, depth - beyond / (from > 0.0 ? falling : rising));
      }
      table_[0].push_back(highest - pitch_line);
    }
    count_ = {n, 1};
    const double starts = text.value("starts", 1.0) * (text.value("hand", "right") == "left" ? 1.0 : -1.0);
    if (parameters == 2) vector_.push_back(starts / text.value("turn", 2.0 * std::numbers::pi));
    vector_.push_back(1.0 / pitch);
    phase_ = -text.value("offset", 0.0) / pitch;
    origin_ = {0.0};
    spacing_ = {1.0 / n};
  } else {
    kind_ = type == "sum" ? Kind::sum : Kind::product;
    for (const json& part : text.at("of")) parts_.emplace_back(part, parameters);
  }
}

double Height::spline(int a, double s, std::array<double, 4>& weights) const {
  const std::size_t k = static_cast<std::size_t>(a);
  const double u = (s - origin_[k]) / spacing_[k], first = std::floor(u), f = u - first, g = 1.0 - f;
  weights = {g * g * g / 6.0, (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0,
             (4.0 - 6.0 * g * g + 3.0 * g * g * g) / 6.0, f * f * f / 6.0};
  return first;
}

double Height::turns(const double* s) const {
  double turns = phase_;
  for (std::size_t a = 0; a < vector_.size(); ++a) turns += vector_[a] * s[a];
  return turns;
}

double Height::operator()(const double* s) const {
  switch (kind_) {
  case Kind::none:
    return 0.0;
  case Kind::constant:
    return value_;
  case Kind::sine: {
    double turns = 0.0;
    for (std::size_t a = 0; a < vector_.size(); ++a) turns += vector_[a] * s[a];
    return value_ * std::sin(2.0 * std::numbers::pi * turns + phase_);
  }
  case Kind::polynomial: {
    double sum = 0.0, power_1 = 1.0;
    for (const auto& row : table_) {
      double power_2 = 1.0;
      for (const double c : row) {
        sum += c * power_1 * power_2;
        if (parameters_ == 2) power_2 *= s[1];
      }
      power_1 *= s[0];
    }
    return sum;
  }
  case Kind::gaussian: {
    double square = 0.0;
    for (std::size_t a = 0; a < vector_.size(); ++a) square += (s[a] - vector_[a]) * (s[a] - vector_[a]);
    return value_ * std::exp(-square / (2.0 * width_ * width_));
  }
  case Kind::map: {
    std::array<double, 4> w1{}, w2{0.0, 1.0, 0.0, 0.0};
    const long i = static_cast<long>(spline(0, s[0], w1));
    const long j = parameters_ == 2 ? static_cast<long>(spline(1, s[1], w2)) : 0;
    double sum = 0.0;
    for (int b = 0; b < 4; ++b)
      for (int a = 0; a < 4; ++a)
        sum += w1[static_cast<std::size_t>(a)] * w2[static_cast<std::size_t>(b)] *
               table_[parameters_ == 2 ? place(j + b - 1, count_[1], periodic_) : 0]
                     [place(i + a - 1, count_[0], periodic_)];
    return sum;
  }
  case Kind::thread: {
    std::array<double, 4> w{};
    const long i = static_cast<long>(spline(0, turns(s), w));
    double sum = 0.0;
    for (int a = 0; a < 4; ++a)
      sum += w[static_cast<std::size_t>(a)] * table_[0][place(i + a - 1, count_[0], true)];
    return sum;
  }
  case Kind::sum: {
    double sum = 0.0;
    for (const Height& part : parts_) sum += part(s);
    return sum;
  }
  case Kind::product: {
    double product = 1.0;
    for (const Height& part : parts_) product *= part(s);
    return product;
  }
  }
  return 0.0;
}

long Height::cell(const double* s) const {
  long cell = 0;
  std::array<double, 4> unused{};
  if (kind_ == Kind::map)
    for (int a = 0; a < parameters_; ++a) cell = 4096 * cell + static_cast<long>(spline(a, s[a], unused));
  if (kind_ == Kind::thread) cell = static_cast<long>(spline(0, turns(s), unused));
  for (const Height& part : parts_) cell = 65536 * cell + part.cell(s);
  return cell;
}

const std::vector<std::string>& height_kinds() {
  static const std::vector<std::string> kinds = {"none", "constant", "sine", "polynomial", "gaussian",
                                                 "sum",  "product",  "map",  "thread"};
  return kinds;
}

json draw_height(Random& random, const std::string& kind, int parameters) {
  const int t = parameters;
  const auto two_of = [&](const char* first, const char* second) {
    json parts = json::array();
    parts.push_back(draw_height(random, first, t));
    parts.push_back(draw_height(random, second, t));
    return parts;
  };
  const auto sign = [&] { return random.coin() ? 1.0 : -1.0; };
  if (kind == "none") return nullptr;
  if (kind == "constant") return {{"type", "constant"}, {"value", random.uniform(-0.2, 0.2)}};
  if (kind == "sine") {
    json wave_vector = json::array();
    for (int a = 0; a < t; ++a) wave_vector.push_back(sign() * random.uniform(0.2, t == 1 ? 0.9 : 0.7));
    return {{"type", "sine"},
            {"amplitude", random.uniform(0.015, 0.06)},
            {"wave_vector", wave_vector},
            {"phase", random.uniform(-3.14, 3.14)}};
  }
  if (kind == "polynomial")
    return {{"type", "polynomial"},
            {"coefficients", t == 1 ? numbers(random, 5, 0.1) : table(random, 4, 4, 0.05)}};
  if (kind == "gaussian")
    return {{"type", "gaussian"},
            {"amplitude", sign() * random.uniform(0.004, 0.07)},
            {"center", numbers(random, t, 0.3)},
            {"width", random.uniform(0.35, 0.8)}};
  if (kind == "sum") return {{"type", "sum"}, {"of", two_of("sine", "gaussian")}};
  if (kind == "product") return {{"type", "product"}, {"of", two_of("sine", "polynomial")}};
  if (kind == "thread") {
    const double pitch = random.uniform(2.0, 3.0);
    json thread = {{"type", "thread"},
                   {"pitch", pitch},
                   {"flank_angles", {random.uniform(72.0, 82.0), random.uniform(72.0, 82.0)}},
                   {"crest", pitch * random.uniform(0.05, 0.3)},
                   {"root", pitch * random.uniform(0.05, 0.3)},
                   {"rounding", pitch * random.uniform(0.15, 0.25)},
                   {"offset", random.uniform(-1.0, 1.0)}};
    if (t == 2) {
      thread["starts"] = random.below(4);
      thread["turn"] = random.uniform(8.0, 12.0);
      thread["hand"] = random.coin() ? "left" : "right";
    }
    return thread;
  }
  const int columns = 6 + random.below(5), rows = 6 + random.below(5);
  json size = json::array(), origin = json::array();
  for (int a = 0; a < t; ++a) {
    size.push_back(random.uniform(2.2, 3.0));
    origin.push_back(random.uniform(-1.4, -0.6));
  }
  return {{"type", "map"},
          {"values", t == 1 ? numbers(random, columns, 0.02) : table(random, rows, columns, 0.015)},
          {"boundary", random.coin() ? "periodic" : "clamped"},
          {"size", size},
          {"origin", origin}};
}

json draw_texture(Random& random, int parameters) {
  const auto wave = [&](double amplitude, double longest) {
    json wave_vector = json::array();
    for (int a = 0; a < parameters; ++a) wave_vector.push_back(random.uniform(-longest, longest));
    return json{{"type", "sine"},
                {"amplitude", amplitude},
                {"wave_vector", wave_vector},
                {"phase", random.uniform(-3, 3)}};
  };
  const int choice = random.below(4);
  if (choice == 0) return wave(random.uniform(0.01, 0.05), 2.5);
  if (choice == 1) {
    json parts = json::array();
    parts.push_back(wave(random.uniform(0.01, 0.04), 1.0));
    parts.push_back(wave(random.uniform(0.005, 0.02), 2.5));
    return {{"type", "sum"}, {"of", parts}};
  }
  json map = draw_height(random, "map", parameters);
  if (choice == 2) return map;
  return draw_height(random, height_kinds()[static_cast<std::size_t>(random.below(7))], parameters);
}

json rescale_height(const json& height, double height_factor, double coordinate_factor) {
  if (height.is_null()) return height;
  json out = height;
  const std::string type = height.at("type");
  const auto scale = [&](const char* key, double factor) { out[key] = times(height.at(key), factor); };
  if (type == "constant") scale("value", height_factor);
  if (type == "sine") {
    scale("amplitude", height_factor);
    scale("wave_vector", 1.0 / coordinate_factor);
  }
  if (type == "polynomial") {
    json& c = out["coefficients"];
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double row = height_factor / std::pow(coordinate_factor, static_cast<double>(i));
      if (c[i].is_number())
        c[i] = c[i].get<double>() * row;
      else
        for (std::size_t j = 0; j < c[i].size(); ++j)
          c[i][j] = c[i][j].get<double>() * row / std::pow(coordinate_factor, static_cast<double>(j));
    }
  }
  if (type == "gaussian") {
    scale("amplitude", height_factor);
    scale("center", coordinate_factor);
    scale("width", coordinate_factor);
  }
  if (type == "thread") {
    for (const char* key : {"pitch", "crest", "root", "rounding", "offset"}) scale(key, coordinate_factor);
    if (height.contains("turn")) scale("turn", coordinate_factor);
    if (height_factor != coordinate_factor) // the flanks keep their angles, which have bounds
      return {
          {"type", "product"},
          {"of", json::array({{{"type", "constant"}, {"value", height_factor / coordinate_factor}}, out})}};
  }
  if (type == "map") {
    scale("values", height_factor);
    scale("size", coordinate_factor);
    scale("origin", coordinate_factor);
  }
  if (type == "sum" || type == "product")
    for (std::size_t i = 0; i < out["of"].size(); ++i)
      out["of"][i] = rescale_height(height.at("of")[i], type == "product" && i > 0 ? 1.0 : height_factor,
                                    coordinate_factor);
  return out;
}

json negative_height(const json& height) {
  if (height.is_null()) return height;
  const json minus_one = {{"type", "constant"}, {"value", -1.0}};
  return {{"type", "product"}, {"of", json::array({minus_one, height})}};
}

} // namespace mechanics
