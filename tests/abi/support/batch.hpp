// SPDX-License-Identifier: BSD-3-Clause
// Calls of several elements.
#pragma once

#include "support/element.hpp"

namespace test {

// Registers of two and four end with the arrays; one of eight leaves a rest.
inline constexpr std::size_t batch_size = 12;
// What is computed for one element per lane; with a result beyond it a call goes element by element.
inline constexpr int32_t in_blocks = want_element | want_values;

// The arrays of a batch: input i is shared by all elements if bit i of `shared` is set, else `padding`
// doubles lie between.
struct Batch {
  Batch(const Model& model, const std::vector<Element>& given, unsigned shared, std::size_t padding,
        int32_t wanted = want_all)
      : elements(given) {
    input.struct_size = sizeof input;
    output.struct_size = sizeof output;
    for (int i = 0; i < input_count; ++i) {
      auto& array = in[static_cast<std::size_t>(i)];
      const std::size_t size = elements[0][i].size();
      if (size == 0) continue;
      const bool all = (shared >> i) & 1u;
      for (Element& e : elements) {
        if (all) e[i] = elements[0][i];
        if (all && !array.empty()) continue;
        array.insert(array.end(), e[i].begin(), e[i].end());
        array.insert(array.end(), all ? 0 : padding, 1e300);
      }
      array.shrink_to_fit(); // so that sanitizers see what is read behind it
      input.*inputs[i].pointer = array.data();
      input.*inputs[i].stride = all ? 0 : static_cast<int64_t>(size + padding);
    }
    for (int i = 0; i < output_count; ++i) {
      auto& array = out[static_cast<std::size_t>(i)];
      stride.push_back(size_of_output(model.layout, i) + padding);
      array.assign(batch_size * stride.back(), -7.0);
      output.*outputs[i].pointer = array.data();
      output.*outputs[i].stride = static_cast<int64_t>(stride.back());
    }
    integers.assign(3, std::vector<int32_t>(batch_size * (1 + padding), -7));
    output.flags = integers[0].data();
    output.iterations = integers[1].data();
    output.status = integers[2].data();
    output.flags_stride = output.iterations_stride = output.status_stride = static_cast<int64_t>(1 + padding);
    output.wanted = wanted;
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  std::vector<Element> elements;
  std::array<std::vector<double>, input_count> in;
  std::array<std::vector<double>, output_count> out;
  std::vector<std::size_t> stride;
  std::vector<std::vector<int32_t>> integers;
  ents_input input{};
  ents_output output{};
};

inline std::vector<Element> draw_batch(const Model& model, const Basis& b, Random& random, bool with_states) {
  std::vector<Element> elements;
  const Element base = draw(model, b, random);
  for (std::size_t e = 0; e < batch_size; ++e) {
    Element one = draw(model, b, random);
    if (one[surface_coordinates].empty() != base[surface_coordinates].empty())
      one[surface_coordinates] = base[surface_coordinates];
    elements.push_back(with_states ? with_history(model, std::move(one), random) : std::move(one));
  }
  return elements;
}

} // namespace test
