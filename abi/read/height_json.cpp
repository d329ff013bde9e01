// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/height_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "abi/read/function_json.hpp"
#include "abi/read/json_check.hpp"
#include "abi/read/json_tree.hpp"
#include "abi/read/map_json.hpp"
#include "abi/read/model_error.hpp"
#include "abi/read/spectral_json.hpp"
#include "core/height/thread.hpp"
#include "core/model/binding.hpp"

namespace ents {

namespace {

using nlohmann::json;

constexpr std::size_t most_coefficients = 64; // per surface coordinate
constexpr std::size_t most_parts = 1024;      // of a sum or product

std::vector<double> read_surface_vector(const json& value, const std::string& path, const char* key,
                                        const HeightSources& sources) {
  return read_vector(value.at(key), member(path, key), static_cast<std::size_t>(sources.dimension),
                     Range::any, per_coordinate);
}

// Numbers of a height that may be those of named parameters.
class BoundNumbers {
public:
  explicit BoundNumbers(const HeightSources& sources) : sources_(sources) {}
  // slot: of HeightNode::bound_to
  double read(const json& value, const std::string& path, std::int32_t slot) {
    return read_bound_double(value, path, Range::any, sources_.parameters, bound_to_[slot]);
  }
  std::vector<double> read_vector_of(const json& value, const std::string& path, std::int32_t first_slot) {
    const auto n = static_cast<std::size_t>(sources_.dimension);
    if (!value.is_array() || value.size() != n) read_vector(value, path, n, Range::any, per_coordinate);
    std::vector<double> result;
    for (std::size_t a = 0; a < n; ++a)
      result.push_back(read(value[a], item(path, a), first_slot + static_cast<std::int32_t>(a)));
    return result;
  }
  Height bind(Height height) const {
    for (std::int32_t slot = 0; slot < 4; ++slot)
      if (bound_to_[slot] != 0) height.bind(slot, bound_to_[slot] - 1);
    return height;
  }

private:
  const HeightSources& sources_;
  std::uint8_t bound_to_[4] = {};
};

// A formula: what its table says
template <template <class> class Formula>
Height read_formula(HeightKind kind, const json& value, const std::string& path,
                    const HeightSources& sources) {
  std::vector<std::string_view> required = {"type"}, optional;
  for (const FormulaNumber& number : Formula<double>::table)
    (number.required() ? required : optional).emplace_back(number.key);
  check_keys(value, path, required, optional);
  BoundNumbers bound(sources);
  std::vector<double> numbers;
  std::int32_t slot = 0;
  for (const FormulaNumber& number : Formula<double>::table) {
    const std::string at = member(path, number.key);
    const bool here = value.contains(number.key);
    if (number.kind == FormulaNumber::vector) {
      std::vector<double> vector = number.named ? bound.read_vector_of(value.at(number.key), at, slot)
                                                : read_surface_vector(value, path, number.key, sources);
      vector.resize(2, 0.0);
      numbers.insert(numbers.end(), vector.begin(), vector.end());
    } else if (!here) {
      numbers.push_back(number.otherwise);
    } else if (number.named) {
      numbers.push_back(bound.read(value.at(number.key), at, slot));
    } else {
      const Range range = number.kind == FormulaNumber::positive ? Range::positive : Range::any;
      numbers.push_back(read_double(value, path, number.key, range));
    }
    if (number.named) slot += number.count();
  }
  static_assert(count_numbers(Formula<double>::table) <= most_formula_numbers);
  static_assert(count_numbers(Formula<double>::table, true) <= 4, "see HeightNode::bound_to");
  return bound.bind(Height::formula(kind, sources.dimension, std::move(numbers)));
}

Height read_field(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "name", "points", "boundary", "size"}, {"origin"});
  const std::string& name = read_text(value.at("name"), member(path, "name"));
  auto& names = *sources.fields;
  if (name.empty()) fail(ENTS_BAD_VALUE, member(path, "name"), "is empty; write a name for the field");
  const auto known = std::find(names.begin(), names.end(), name);
  if (known != names.end())
    fail(ENTS_BAD_VALUE, member(path, "name"),
         "is the name of another field of this model; a field stands in a height once");
  if (names.size() == most_fields)
    fail(ENTS_BAD_VALUE, path,
         "is field " + std::to_string(most_fields + 1) + "; a model has at most " +
             std::to_string(most_fields));
  HeightMap map = read_grid(value, path, sources.dimension);
  names.push_back(name);
  return Height::field(std::move(map), static_cast<std::int32_t>(names.size()) - 1);
}

Height read_polynomial(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "coefficients"}, {});
  const json& table = value.at("coefficients");
  const std::string table_path = member(path, "coefficients");
  const bool one = sources.dimension == 1;
  check_array(table, table_path, most_coefficients,
              one ? "numbers c[i] of s1^i" : "arrays of numbers, c[i][j] of s1^i s2^j");
  std::vector<double> line;
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string row_path = item(table_path, i);
    if (one) {
      line.push_back(read_double(table[i], row_path, Range::any));
      continue;
    }
    check_array(table[i], row_path, most_coefficients, "numbers c[i][j] of s1^i s2^j");
    rows.emplace_back();
    for (std::size_t j = 0; j < table[i].size(); ++j)
      rows.back().push_back(read_double(table[i][j], item(row_path, j), Range::any));
  }
  return one ? Height::polynomial(std::move(line)) : Height::bivariate_polynomial(rows);
}

// A number within low .. high; `text` says so.
double read_within(const json& value, const std::string& path, double low, double high,
                   const std::string& text) {
  const double number = read_double(value, path, Range::any);
  if (!(number >= low && number <= high))
    fail(ENTS_BAD_VALUE, path, "is " + shown(number) + "; write " + text);
  return number;
}

ThreadProfile read_thread_profile(const json& value, const std::string& path) {
  ThreadProfile p{};
  p.pitch = read_double(value, path, "pitch", Range::positive);
  const std::string angles = member(path, "flank_angles");
  if (const json& flanks = value.at("flank_angles"); flanks.is_array() && flanks.size() == 2) {
    constexpr double degree = std::numbers::pi / 180.0;
    p.rising = degree * read_within(flanks[0], item(angles, 0), 0.1, 89.0, "degrees from 0.1 to 89");
    p.falling = degree * read_within(flanks[1], item(angles, 1), 0.1, 89.0, "degrees from 0.1 to 89");
  } else {
    read_vector(flanks, angles, 2, Range::any,
                "degrees, of the flank that rises along the axis and of the one that falls");
  }
  const auto width = [&](const char* key) {
    return read_within(value.at(key), member(path, key), 0.0, p.pitch, "a length from 0 to the pitch");
  };
  p.crest = width("crest");
  p.root = width("root");
  if (!(p.crest + p.root < p.pitch))
    fail(ENTS_BAD_VALUE, path,
         "\"crest\" and \"root\" leave nothing of \"pitch\" for the flanks; make one of them narrower");
  const std::string at = member(path, "rounding");
  p.rounding = value.contains("rounding")
                   ? read_within(value.at("rounding"), at, p.pitch / 2048.0, p.pitch / 4.0,
                                 "a length from pitch / 2048 to pitch / 4")
                   : p.pitch / 16.0;
  return p;
}

Height read_thread(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "pitch", "flank_angles", "crest", "root"},
             {"rounding", "offset", "starts", "turn", "hand"});
  const bool winds = sources.dimension == 2;
  for (const char* key : {"starts", "turn", "hand"})
    if (!winds && value.contains(key))
      fail(ENTS_BAD_VALUE, member(path, key),
           "a line segment has no angle round the axis, only lengths along it; remove this key");
  const ThreadProfile profile = read_thread_profile(value, path);
  const double offset = read_double_or(value, path, "offset", Range::any, 0.0) / profile.pitch;
  std::vector<double> wave_vector = {1.0 / profile.pitch};
  if (winds) {
    const double starts = value.contains("starts") ? read_within(value.at("starts"), member(path, "starts"),
                                                                 0.0, 64.0, "a whole number from 0 to 64")
                                                   : 1.0;
    if (starts != std::floor(starts))
      fail(ENTS_BAD_VALUE, member(path, "starts"),
           "is " + shown(starts) + "; write a whole number: others do not close round the axis");
    const bool left =
        value.contains("hand") && read_choice(value.at("hand"), member(path, "hand"), {"right", "left"}) == 1;
    const double ridges_per_angle =
        starts / read_double_or(value, path, "turn", Range::positive, 2.0 * std::numbers::pi);
    wave_vector.insert(wave_vector.begin(), left ? ridges_per_angle : -ridges_per_angle);
  }
  return Height::profile(thread_coefficients(profile), wave_vector, -offset);
}

Height read_at_depth(const json& value, const std::string& path, const HeightSources& sources,
                     std::int32_t depth);

void check_depth(const std::string& path, std::int32_t depth) {
  if (depth == max_height_depth)
    fail(ENTS_BAD_VALUE, path,
         "sums and products nest at most " + std::to_string(max_height_depth) +
             " levels deep, the innermost functions included; merge sums of sums and products of products");
}

std::vector<Height> read_parts(const json& value, const std::string& path, const HeightSources& sources,
                               std::int32_t depth) {
  check_keys(value, path, {"type", "of"}, {});
  const json& of = value.at("of");
  const std::string of_path = member(path, "of");
  check_array(of, of_path, most_parts, "height objects");
  check_depth(path, depth);
  std::vector<Height> parts;
  for (std::size_t i = 0; i < of.size(); ++i)
    parts.push_back(read_at_depth(of[i], item(of_path, i), sources, depth + 1));
  return parts;
}

Height read_sum(const json& value, const std::string& path, const HeightSources& sources,
                std::int32_t depth) {
  return Height::sum(read_parts(value, path, sources, depth));
}
Height read_product(const json& value, const std::string& path, const HeightSources& sources,
                    std::int32_t depth) {
  return Height::product(read_parts(value, path, sources, depth));
}
Height read_map_height(const json& value, const std::string& path, const HeightSources& sources) {
  return Height::map(read_map(value, path, sources));
}

// The one height of "scale", "shift" and "window"
Height read_inner(const json& value, const std::string& path, const HeightSources& sources,
                  std::int32_t depth) {
  check_depth(path, depth);
  return read_at_depth(value.at("of"), member(path, "of"), sources, depth + 1);
}

Height read_scale(const json& value, const std::string& path, const HeightSources& sources,
                  std::int32_t depth) {
  check_keys(value, path, {"type", "by", "of"}, {});
  BoundNumbers numbers(sources);
  const double by = numbers.read(value.at("by"), member(path, "by"), 0);
  std::vector<Height> factors;
  factors.push_back(numbers.bind(Height::constant(sources.dimension, by)));
  factors.push_back(read_inner(value, path, sources, depth));
  return Height::product(std::move(factors));
}

Height read_shift(const json& value, const std::string& path, const HeightSources& sources,
                  std::int32_t depth) {
  check_keys(value, path, {"type", "by", "of"}, {});
  BoundNumbers numbers(sources);
  const std::vector<double> by = numbers.read_vector_of(value.at("by"), member(path, "by"), 0);
  return numbers.bind(Height::shift(read_inner(value, path, sources, depth), by));
}

Height read_window_of(const json& value, const std::string& path, const HeightSources& sources,
                      std::int32_t depth) {
  check_keys(value, path, {"type", "of", "low", "high"}, {});
  return read_window(value, path, sources, read_inner(value, path, sources, depth));
}

#define ENTS_READER(member, Formula)                                                                         \
  Height read_##member(const json& value, const std::string& path, const HeightSources& sources) {           \
    return read_formula<Formula>(HeightKind::member, value, path, sources);                                  \
  }
ENTS_FORMULA_HEIGHTS(ENTS_READER)
#undef ENTS_READER

// depth: level of this height, 1 for the outermost.
Height read_at_depth(const json& value, const std::string& path, const HeightSources& sources,
                     std::int32_t depth) {
  using Flat = Height (*)(const json&, const std::string&, const HeightSources&);
  using Nested = Height (*)(const json&, const std::string&, const HeightSources&, std::int32_t);
  static constexpr struct {
    const char* type;
    Flat flat;     // a height without others inside
    Nested nested; // one of others
    bool combined; // a sum or product to the library
  } types[] = {
#define ENTS_ROW(member, Formula) {Formula<double>::type, read_##member, nullptr, false},
      ENTS_FORMULA_HEIGHTS(ENTS_ROW)
#undef ENTS_ROW
          {"polynomial", read_polynomial, nullptr, false},
      {"map", read_map_height, nullptr, false},
      {"thread", read_thread, nullptr, false},
      {"field", read_field, nullptr, false},
      {"callback", read_callback, nullptr, false},
      {"expression", read_expression, nullptr, false},
      {"roughness", read_roughness, nullptr, false},
      {"fourier", read_fourier, nullptr, true},
      {"weierstrass", read_weierstrass, nullptr, true},
      {"sum", nullptr, read_sum, false},
      {"product", nullptr, read_product, false},
      {"scale", nullptr, read_scale, false},
      {"shift", nullptr, read_shift, false},
      {"window", nullptr, read_window_of, false}};
  std::vector<std::string_view> names;
  for (const auto& type : types) names.emplace_back(type.type);
  const auto& type = types[read_type(value, path, names)];
  if (type.combined) check_depth(path, depth);
  return type.flat ? type.flat(value, path, sources) : type.nested(value, path, sources, depth);
}

} // namespace

double read_bound_double(const json& value, const std::string& path, Range range,
                         std::span<const NamedParameter> parameters, std::uint8_t& bound_to) {
  bound_to = 0;
  if (!value.is_string()) return read_double(value, path, range);
  const std::string& name = read_text(value, path);
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    names.emplace_back(parameters[i].name);
    if (parameters[i].name != name) continue;
    bound_to = static_cast<std::uint8_t>(i + 1);
    return parameters[i].value;
  }
  fail(ENTS_BAD_VALUE, path,
       "is the text " + in_quotes(name) + "; write a number, or a name that the model's \"parameters\" have" +
           (names.empty() ? " (they have none)" : ": " + alternatives(names)));
}

Height read_height(const json& value, const std::string& path, const HeightSources& sources) {
  return read_at_depth(value, path, sources, 1);
}

} // namespace ents
