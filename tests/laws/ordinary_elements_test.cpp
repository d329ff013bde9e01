// Ordinary elements, that is nearly all, are evaluated by kernels of their own, many at once, compiled for
// several instruction sets (core/projection/projected_point.hpp). Nothing of that may show: the bits of an element do
// not depend on its neighbours in the call, on the length of the call or on the processor; and the kernels
// that take the elements one by one say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>

#include "abi/call/handle.hpp"
#include "core/element/make_plan.hpp"
#include "parts_of_calls.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::ordinary_elements_test {
namespace {

// From now on the model takes the kernels of this instruction set; null: it takes elements one by one.
void use(const mechanics::Model& model, const ents::BlockKernels* kernels) {
  ents::Plan& plan = const_cast<ents_model*>(model.handle())->plan;
  const ents::ModelSpec& m = model.handle()->model;
  plan.block = plan.block_without_friction = nullptr;
  if (kernels) ents::set_block_kernels(m, *kernels, plan);
  plan.block_results = plan.block ? ents::want::block | (plan.heat ? ents::want::heat : 0) : 0;
}

struct Case {
  std::string basis, height;
  Method method;
  const char* master;
  const char *projection = "normal", *tangent = "consistent";
  bool symmetrised = false;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.basis << " " << c.height << " " << c.method.name << " " << c.master << " " << c.projection << " "
       << c.tangent << (c.symmetrised ? " symmetrised" : "");
}

// Every law, on every basis; both shadow projections, every kind of tangent; heights in turn.
std::vector<Case> cases(std::size_t round = 0) {
  std::vector<Case> all;
  std::size_t turn = 0, first = round; // each basis begins at another height
  const auto add = [&](Case c) {
    for (const std::string& height : heights_in_turn(turn++)) all.push_back(c), all.back().height = height;
  };
  for (const std::string& basis : mechanics::all_basis_names()) {
    turn = first, first += 3;
    for (const Method& method : methods())
      for (const char* master : {"deformable", "rigid"}) add({basis, "", method, master});
    for (const Method& method : methods_with_wear()) add({basis, "", method, "deformable"});
    std::size_t heated = first; // each fourth of the laws, on each basis others
    for (const Method& method : methods_with_heat())
      if (heated++ % 4 == 0) add({basis, "", method, "deformable"});
    for (const std::size_t law : {1u, 9u}) { // penalty and exponential law with Coulomb friction
      const Method method = methods()[law];
      for (const char* projection : {"shadow_point", "shadow_direction"})
        add({basis, "", method, "deformable", projection});
      for (const char* tangent : {"small_gap", "first_variation"})
        add({basis, "", method, "deformable", "normal", tangent});
      add({basis, "", method, "deformable", "normal", "consistent", true});
    }
  }
  return all;
}

// Those of the kernel of penalty and power law.
std::vector<Case> fast_cases() {
  std::vector<Case> fast;
  for (const Case& c : cases())
    if ((c.method.normal["type"] == "penalty" || c.method.normal["type"] == "power") &&
        c.method.wear.is_null() && c.method.heat.is_null() && std::string(c.projection) == "normal" &&
        std::string(c.tangent) == "consistent" && !c.symmetrised)
      fast.push_back(c);
  return fast;
}

mechanics::Model model_of(const mechanics::Scene& scene, const Case& c) {
  json text = scene.model();
  text["master"] = c.master;
  text["tangent"] = c.tangent;
  text["contact"] = {{"normal", c.method.normal},
                     {"friction", c.method.friction},
                     {"wear", c.method.wear},
                     {"heat", c.method.heat}};
  if (c.symmetrised) text["contact"]["symmetrised"] = true;
  return mechanics::Model(text.dump());
}

class OrdinaryElements : public testing::Test {
protected:
  struct Drawn {
    mechanics::Scene scene;
    LawElements elements;
  };
  // Every seventh start is far off, so that calls mix elements that are ordinary with others. Every eleventh
  // has no area: zeros, whose signs are bits, too.
  static Drawn draw_mixed(const Case& c, std::size_t round = 0) {
    Random random(std::hash<std::string>{}(c.basis + c.height + c.method.name) + 7919 * round);
    Drawn d;
    d.scene = mechanics::draw_scene(random, mechanics::basis_named(c.basis), c.height, c.projection);
    d.elements = draw(random, d.scene, model_of(d.scene, c), call_size, 0.05);
    for (std::size_t e = 0; e < static_cast<std::size_t>(call_size); e += 7)
      d.elements.state[e * static_cast<std::size_t>(d.elements.layout.state_size) + 3] += 0.7;
    for (std::size_t e = 5; e < static_cast<std::size_t>(call_size); e += 11) d.elements.at.area[e] = 0.0;
    return d;
  }

  // f(case, its elements) of half of the cases, drawn, or of all with ENTS_TEST_SAMPLES=all; ENTS_TEST_ROUNDS: how
  // many times, each with other elements
  template <class F> static void for_each_case(F&& f) {
    const char* text = std::getenv("ENTS_TEST_ROUNDS");
    const std::size_t rounds = text ? std::strtoull(text, nullptr, 10) : 1;
    std::map<std::string, std::int64_t> elements;
    Random half(7);
    for (std::size_t round = 0; round < rounds; ++round)
      for (const Case& c : cases(round)) {
        if (HasFatalFailure()) return;
        if (half.coin() && mechanics::long_divisor() > 1) continue;
        f(c, draw_mixed(c, round));
        elements[c.method.name] += call_size;
      }
    std::int64_t least = elements.begin()->second;
    for (const auto& law : elements) least = std::min(least, law.second);
    std::cout << elements.size() << " laws, at least " << least << " elements of each\n";
  }
};

TEST_F(OrdinaryElements, HaveTheSameBitsAloneAndInAnyCall) {
  for_each_case([](const Case& c, const Drawn& d) {
    const mechanics::Model model = model_of(d.scene, c);
    LawResults all;
    evaluate(model, d.elements, call_results, all);
    for (const std::int64_t size : {std::int64_t{1}, std::int64_t{13}, std::int64_t{64}})
      for (std::int64_t first = 0; first + size <= call_size; first += size) {
        LawResults some;
        evaluate(model, part(d.elements, first, size), call_results, some);
        ASSERT_TRUE(same(all, some, first, d.elements.layout))
            << testing::PrintToString(c) << " elements " << first << " + " << size;
      }
    LawResults residual; // what else is wanted does not matter
    evaluate(model, d.elements, ENTS_RESIDUAL, residual);
    ASSERT_TRUE(same(all.residual, residual.residual)) << testing::PrintToString(c);
    LawResults more;
    evaluate(model, d.elements, call_results | ENTS_TRACTION, more);
    ASSERT_TRUE(same(all, more, 0, d.elements.layout)) << testing::PrintToString(c);
  });
}

// Calls whose results no cache holds write them block by block to one that does, and copy them beside the
// next: once by elements, once by columns.
TEST_F(OrdinaryElements, HaveTheSameBitsInLongCallsOfEveryKind) {
  const Method frictionless = {"penalty", {{"type", "penalty"}, {"stiffness", 100.0}}, nullptr};
  Method friction = frictionless;
  friction.friction = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 80.0}};
  for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
    for (const char* height : {"none", "sine"})
      for (const Method& method : {frictionless, friction}) {
        Random random(6);
        const mechanics::Scene scene =
            mechanics::draw_scene(random, mechanics::basis_named(basis), height, "normal");
        const mechanics::Model model = model_of(scene, method);
        const std::int64_t dofs = draw(random, scene, model, 1, 0.05).layout.dofs,
                           many = (std::int64_t{1} << 19) / (dofs * dofs) + 100;
        LawElements elements = draw(random, scene, model, many, 0.05);
        const ents_layout& l = elements.layout;
        for (std::int64_t e = 70; e < many; e += 200) // blocks that are not ordinary as a whole
          elements.state[static_cast<std::size_t>(e * l.state_size + 3)] += 0.7;
        for (const std::int32_t results : {call_results, ENTS_RESIDUAL | ENTS_TANGENT, +ENTS_TANGENT}) {
          LawResults all;
          evaluate(model, elements, results, all);
          for (std::int64_t first = 0; first < many; first += 60) {
            LawResults some;
            evaluate(model, part(elements, first, std::min<std::int64_t>(60, many - first)), results, some);
            ASSERT_TRUE(same(all, some, first, l))
                << basis << " " << height << " " << method.friction << " element " << first;
          }
        }
      }
}
TEST_F(OrdinaryElements, HaveTheSameBitsInLongCalls) {
  constexpr std::int64_t many = 15000, padded = 50; // more than 2^19 numbers of 6 x 6
  const Method method = {"penalty", {{"type", "penalty"}, {"stiffness", 100.0}}, nullptr};
  Random random(5);
  const mechanics::Scene scene =
      mechanics::draw_scene(random, mechanics::basis_named("line2"), "sine", "normal");
  const mechanics::Model model = model_of(scene, method);
  LawElements elements = draw(random, scene, model, many, 0.05);
  const ents_layout& l = elements.layout;
  for (std::int64_t e = 0; e < many; e += 1000) // blocks that are not ordinary as a whole
    elements.state[static_cast<std::size_t>(e * l.state_size + 3)] += 0.7;
  LawResults all;
  evaluate(model, elements, call_results, all);
  for (std::int64_t first = 0; first < many; first += 60) {
    LawResults some;
    evaluate(model, part(elements, first, 60), call_results, some);
    ASSERT_TRUE(same(all, some, first, l)) << first;
  }
  std::vector<double> tangent(static_cast<std::size_t>(many * padded), -7.0);
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = elements.at.slave.data(), in.slave_stride = 2;
  in.master = elements.at.master.data(), in.master_stride = 4;
  if (!elements.at.surface_coordinates.empty())
    in.surface_coordinates = elements.at.surface_coordinates.data(), in.surface_coordinates_stride = 2;
  in.area = elements.at.area.data(), in.area_stride = 1;
  in.state_begin = elements.state.data(), in.state_begin_stride = l.state_size;
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_TANGENT;
  out.tangent = tangent.data(), out.tangent_stride = padded;
  ASSERT_EQ(ents_evaluate(model.handle(), 0, many, &in, &out, nullptr), ENTS_OK);
  for (std::size_t e = 0; e < static_cast<std::size_t>(many); ++e) {
    ASSERT_EQ(std::memcmp(&tangent[e * padded], &all.tangent[e * 36], 36 * sizeof(double)), 0) << e;
    for (std::size_t i = 36; i < padded; ++i) ASSERT_EQ(tangent[e * padded + i], -7.0) << e;
  }
  for (const std::size_t before : {8, 9, 15}) { // wherever the array begins, nothing beside it is written
    std::vector<double> side_by_side(before + many * 36 + 8, -7.0);
    out.tangent = side_by_side.data() + before, out.tangent_stride = 36;
    ASSERT_EQ(ents_evaluate(model.handle(), 0, many, &in, &out, nullptr), ENTS_OK);
    ASSERT_EQ(std::memcmp(out.tangent, all.tangent.data(), many * 36 * sizeof(double)), 0) << before;
    for (std::size_t i = 0; i < 8; ++i) {
      ASSERT_EQ(side_by_side[before - 1 - i], -7.0) << before;
      ASSERT_EQ(side_by_side[before + many * 36 + i], -7.0) << before;
    }
  }
}

// A rigid master leaves the slave's own rows and columns.
TEST_F(OrdinaryElements, OfARigidMasterAreAPartOfThoseOfADeformableOne) {
  std::int64_t in_contact = 0;
  for (Case c : fast_cases()) {
    if (std::strcmp(c.master, "rigid") == 0) continue;
    Drawn d = draw_mixed(c);
    LawResults whole, rigid;
    evaluate(model_of(d.scene, c.method), d.elements, call_results, whole);
    const std::size_t n = static_cast<std::size_t>(d.elements.layout.dofs),
                      dim = static_cast<std::size_t>(d.elements.layout.dimension);
    const mechanics::Model model = model_of(d.scene, c.method, "rigid");
    d.elements.layout = layout_of(model.handle());
    evaluate(model, d.elements, call_results, rigid);
    ASSERT_EQ(rigid.status, whole.status) << testing::PrintToString(c);
    ASSERT_EQ(rigid.flags, whole.flags) << testing::PrintToString(c);
    ASSERT_TRUE(same(rigid.state, whole.state)) << testing::PrintToString(c);
    for (std::size_t e = 0; e < static_cast<std::size_t>(call_size); ++e) {
      if (whole.status[e] != ENTS_OK) continue;
      in_contact += whole.flags[e] & ENTS_FLAG_CONTACT;
      for (std::size_t i = 0; i < dim; ++i) {
        ASSERT_EQ(rigid.residual[e * dim + i], whole.residual[e * n + i])
            << testing::PrintToString(c) << " element " << e;
        for (std::size_t j = 0; j < dim; ++j)
          ASSERT_EQ(rigid.tangent[(e * dim + j) * dim + i], whole.tangent[(e * n + j) * n + i])
              << testing::PrintToString(c) << " element " << e;
      }
    }
  }
  EXPECT_GT(in_contact, 10000);
}

TEST_F(OrdinaryElements, HaveTheSameBitsOnEveryInstructionSet) {
  const ents::BlockKernels& best = ents::best_block_kernels();
  std::vector<const ents::BlockKernels*> others;
  if (ents::portable::block_kernels.of_basis) others.push_back(&ents::portable::block_kernels);
#ifdef ENTS_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) others.push_back(&ents::avx2::block_kernels);
#endif
  others.erase(std::remove(others.begin(), others.end(), &best), others.end());
  if (others.empty()) GTEST_SKIP() << "this library has " << best.instruction_set << " alone to run here";
  std::cout << best.instruction_set << " against";
  for (const ents::BlockKernels* other : others) std::cout << " " << other->instruction_set;
  std::cout << "\n";
  for_each_case([&](const Case& c, const Drawn& d) {
    const mechanics::Model model = model_of(d.scene, c);
    LawResults of_best;
    evaluate(model, d.elements, call_results, of_best);
    for (const ents::BlockKernels* kernels : others) {
      LawResults other;
      use(model, kernels);
      evaluate(model, d.elements, call_results, other);
      ASSERT_TRUE(same(of_best, other, 0, d.elements.layout))
          << testing::PrintToString(c) << " " << kernels->instruction_set;
    }
  });
}

// Both solve the projection to rounding. Forces differ by rounding times its condition and that of the
// friction law (trial force over limit, below 100 here): 1e-12 of the largest entry, and stiffness (below
// 400) times rounding of positions, 1e-13; the tangent divides by F_,xixi once more. Elements next to a
// border of the law may fall on different sides of it. Long and narrow triangles: xi comes from normal
// equations in these kernels, whose error grows with the square of the ratio of the sides; from 100 on the
// others take over. A slave below the middle by a hundredth of the width: the gap is known.
TEST_F(OrdinaryElements, KeepTheirAccuracyOnSlivers) {
  for (const double width : {1.0, 1e-1, 2e-2, 1e-2, 1e-3, 1e-5}) {
    const mechanics::Model model(
        R"({"segment": "tri3", "contact": {"normal": {"type": "penalty", "stiffness": 100}}})");
    double worst = 0.0;
    mechanics::Random random(31);
    for (int k = 0; k < 200; ++k) {
      const double turn = random.uniform(0.0, 6.0), lift = random.uniform(-1.0, 1.0), depth = 0.01 * width;
      const auto place = [&](double x, double y, double z) { // turned about two axes, far from the origin
        const double u = x * std::cos(turn) - y * std::sin(turn), v = x * std::sin(turn) + y * std::cos(turn);
        return std::array<double, 3>{u + 1.0, v * std::cos(lift) - z * std::sin(lift),
                                     v * std::sin(lift) + z * std::cos(lift)};
      };
      mechanics::Elements e;
      e.count = 1;
      const double s = random.uniform(0.2, 0.5), t = random.uniform(0.2, 0.4);
      for (const auto& p : {place(0, 0, 0), place(1, 0, 0), place(0.3, width, 0)})
        e.master.insert(e.master.end(), p.begin(), p.end());
      const auto p = place(s + 0.3 * t, width * t, -depth);
      e.slave.assign(p.begin(), p.end());
      e.start = {s, t};
      const mechanics::Results r = model.evaluate(e, ENTS_GAP);
      test::raise(worst, std::abs(r.gap[0] + depth) / depth);
    }
    // the rounding of the nodes alone, 1e-16 of lengths near 1, is 1e-14 / width of the depth
    EXPECT_LT(worst, 1e-13 / width + (width >= 1e-2 ? 1e-13 / (width * width) : 0.0)) << width;
  }
}

TEST_F(OrdinaryElements, SayWhatElementsOneByOneSay) {
  std::int64_t compared = 0, across = 0, contact = 0;
  for (const Case& c : fast_cases()) {
    const Drawn d = draw_mixed(c);
    LawResults block, alone;
    const mechanics::Model model = model_of(d.scene, c);
    evaluate(model, d.elements, call_results, block);
    use(model, nullptr);
    evaluate(model, d.elements, call_results, alone);
    const std::size_t n = static_cast<std::size_t>(d.elements.layout.dofs),
                      size = static_cast<std::size_t>(d.elements.layout.state_size);
    for (std::size_t e = 0; e < static_cast<std::size_t>(call_size); ++e) {
      ASSERT_EQ(block.status[e], alone.status[e]) << testing::PrintToString(c) << " element " << e;
      if (alone.status[e] != ENTS_OK) continue;
      if (block.flags[e] != alone.flags[e]) {
        ++across;
        continue;
      }
      ++compared;
      contact += alone.flags[e] & ENTS_FLAG_CONTACT;
      const auto close = [&](const std::vector<double>& a, const std::vector<double>& b, std::size_t entries,
                             double relative, const char* what) {
        const double tolerance = relative * mechanics::largest_entry(&b[e * entries], entries) + 1e-13;
        for (std::size_t i = 0; i < entries; ++i)
          ASSERT_NEAR(a[e * entries + i], b[e * entries + i], tolerance)
              << what << " " << testing::PrintToString(c) << " element " << e;
      };
      const double bent =
          c.basis == "bezier15" ? 4.0 : 1.0; // control points drawn at random bend a quartic more sharply
      close(block.residual, alone.residual, n, bent * 1e-12, "residual");
      close(block.tangent, alone.tangent, n * n, bent * 1e-11, "tangent");
      close(block.state, alone.state, size, 1e-12, "state");
      ASSERT_NEAR(block.gap[e], alone.gap[e], 1e-14);
      ASSERT_NEAR(block.pressure[e], alone.pressure[e], 1e-11);
    }
  }
  EXPECT_GT(contact, compared / 2);
  EXPECT_LT(across, compared / 1000);
  std::cout << compared << " elements, " << contact << " in contact; " << across
            << " on the other side of a border of the law\n";
}

} // namespace
} // namespace laws::ordinary_elements_test
