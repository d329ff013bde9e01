// SPDX-License-Identifier: BSD-3-Clause
#include "problem.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <Eigen/Dense>

#include "plain_model.hpp"

namespace adapters {
namespace {

struct Kind {
  const char* name;
  int number, dimension;
  const char* model;
};

// Textures of several waves; friction with slip; multipliers as dofs; a penetration limit that asks for cuts.
const Kind kinds[] = {
    {"line2", 11, 2,
     R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8], "phase": 0.3},
         "contact": {"normal": {"type": "penalty", "stiffness": 400}}})"},
    {"line2_friction", 12, 2,
     R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8]},
         "contact": {"normal": {"type": "penalty", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 200}}})"},
    {"quad4", 13, 3,
     R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
         "contact": {"normal": {"type": "penalty", "stiffness": 400}}})"},
    {"quad4_friction", 14, 3,
     R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
         "contact": {"normal": {"type": "penalty", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})"},
    {"tri3_friction", 15, 3,
     R"({"segment": "tri3", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [0.7, 0.4]},
         "contact": {"normal": {"type": "penalty", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})"},
    {"quad4_multiplier", 16, 3,
     R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
         "contact": {"normal": {"type": "augmented_multiplier", "stiffness": 400}}})"},
    // Three of them, each with its own place in the node.
    {"quad4_friction_multiplier", 19, 3,
     R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
         "contact": {"normal": {"type": "augmented_multiplier", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})"},
    {"line2_cuts", 17, 2,
     R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8]}, "penetration_limit": 0.06,
         "contact": {"normal": {"type": "penalty", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 200}}})"},
    {"quad4_cuts", 20, 3,
     R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]}, "penetration_limit": 0.06,
         "contact": {"normal": {"type": "penalty", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})"},
    // Slave nodes slide from the first segment of the element to the second.
    {"line2_patch", 18, 2,
     R"({"segment": "line2", "patch": [[0, 1], [1, 2], [2, 3]],
         "contact": {"normal": {"type": "penalty", "stiffness": 400},
                     "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 200}}})"},
};

} // namespace

std::vector<ProblemName> problem_names() {
  std::vector<ProblemName> names;
  for (const Kind& kind : kinds)
    names.push_back(
        {kind.name, kind.dimension, std::string(kind.name).find("multiplier") != std::string::npos});
  return names;
}

Problem problem(const std::string& name) {
  const Kind* kind = kinds;
  while (kind->name != name) ++kind;
  const std::string file = "ents_" + std::to_string(kind->number) + ".json";
  // Whole or not at all: other test programs may be reading it.
  const std::string draft = file + "." + std::to_string(std::random_device{}());
  std::ofstream(draft) << kind->model;
  std::filesystem::rename(draft, file);
  const PlainModel model(file);
  const ents_layout& layout = model.layout();

  Problem p;
  p.name = name;
  Elements& e = p.elements;
  e.dimension = kind->dimension;
  e.model = kind->number;
  e.state_size = layout.state_size;
  e.multipliers = layout.multipliers;
  e.symmetric = layout.symmetric_tangent != 0;
  const int d = e.dimension, m = layout.nodes;
  std::mt19937_64 engine(20110u + static_cast<unsigned>(kind->number));
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  };
  const auto add_node = [&](std::vector<double> x, std::vector<double> target, double stiffness) {
    for (int i = 0; i < d; ++i) {
      e.reference.push_back(x[static_cast<std::size_t>(i)]);
      p.target.push_back(target[static_cast<std::size_t>(i)]);
      for (int j = 0; j < d; ++j)
        p.spring.push_back(i == j ? stiffness * uniform(0.8, 1.2) : 0.2 * stiffness * uniform(-1, 1));
    }
    return e.unknowns() / d - 1;
  };

  // Segments apart from each other; corners of [-1, 1]^(d-1), pushed about.
  const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int segment = 0; segment < 3; ++segment) {
    std::vector<int> master;
    for (int i = 0; i < m; ++i) {
      std::vector<double> x(static_cast<std::size_t>(d));
      for (int a = 0; a + 1 < d; ++a)
        x[static_cast<std::size_t>(a)] =
            (a == 0 ? 4.0 * segment : 0.0) + (d == 2 ? 2.0 * i - 1 : corners[i][a]) + uniform(-0.15, 0.15);
      x.back() = uniform(-0.1, 0.1);
      master.push_back(add_node(x, std::vector<double>(static_cast<std::size_t>(d), 0.0), 300));
    }
    for (int s = 0; s < 3; ++s) {
      std::vector<double> x(static_cast<std::size_t>(d)), target(static_cast<std::size_t>(d));
      for (int a = 0; a + 1 < d; ++a) {
        const double middle = a == 0 ? 4.0 * segment : 0.0;
        x[static_cast<std::size_t>(a)] = middle + (m == 3 ? -0.35 : 0.0) + uniform(-0.3, 0.1);
        target[static_cast<std::size_t>(a)] = uniform(0.1, 0.2);
      }
      if (m == 4 && d == 2) { // a polyline
        x[0] = 4.0 * segment + uniform(0.7, 0.8);
        target[0] = uniform(0.5, 0.6);
      }
      x.back() = uniform(0.12, 0.2);
      target.back() = -uniform(0.25, 0.4);
      std::vector<int> nodes{add_node(x, target, 40)};
      nodes.insert(nodes.end(), master.begin(), master.end());
      // The dofs of a multiplier's node that it does not use hang on springs, too; its own start from
      // nothing.
      if (e.multipliers) {
        nodes.push_back(add_node(x, std::vector<double>(static_cast<std::size_t>(d), 0.0), 1));
        for (int i = 0; i < d; ++i)
          for (int j = 0; j < d; ++j)
            if (i < e.multipliers || j < e.multipliers)
              p.spring[p.spring.size() - static_cast<std::size_t>(d * d - i * d - j)] = 0;
      }
      e.nodes.push_back(nodes);
      e.area.push_back(uniform(0.3, 0.7));
    }
  }
  return p;
}

std::vector<double> pressed(const Problem& p) {
  std::vector<double> u(p.target.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = 0.55 * p.target[i] + 1e-3 * static_cast<double>(i % 5);
  return u;
}

Solution solve(const Problem& p, EmulatedHost& host) {
  const Elements& e = p.elements;
  const int d = e.dimension, n = e.unknowns();
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  Solution solution;
  std::vector<double> accepted(at(n), 0.0);
  double load = 0, step = 1.0 / p.increments;
  while (load < 1 - 1e-12) {
    const double next = std::min(1.0, load + step);
    std::vector<double> u = accepted;
    host.begin(accepted);
    double cut = 1;
    int iterations = 0;
    bool converged = false;
    solution.in_contact = 0;
    while (!converged) {
      if (++iterations > 40) throw std::runtime_error("no convergence");
      Eigen::VectorXd residual = Eigen::VectorXd::Zero(n);
      Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(n, n);
      for (int node = 0; node < n / d; ++node)
        for (int i = 0; i < d; ++i)
          for (int j = 0; j < d; ++j) {
            const double stiffness = p.spring[at((node * d + i) * d + j)];
            residual(node * d + i) += stiffness * (u[at(node * d + j)] - next * p.target[at(node * d + j)]);
            tangent(node * d + i, node * d + j) += stiffness;
          }
      double size = residual.norm();
      solution.in_contact = 0;
      for (int k = 0; k < static_cast<int>(e.nodes.size()) && cut == 1; ++k) {
        const Answer answer = host.evaluate(k, u);
        if (answer.residual.empty()) {
          cut = answer.step_factor;
          break;
        }
        const auto& nodes = e.nodes[at(k)];
        const int rows = static_cast<int>(nodes.size()) * d;
        double force = 0;
        for (int i = 0; i < rows; ++i) {
          const int row = nodes[at(i / d)] * d + i % d;
          force += std::abs(answer.residual[at(i)]);
          residual(row) += answer.residual[at(i)];
          for (int j = 0; j < rows; ++j)
            tangent(row, nodes[at(j / d)] * d + j % d) += answer.tangent[at(i + rows * j)];
        }
        size += force;
        solution.in_contact += force > 1e-6;
      }
      if (cut < 1) break;
      if (residual.norm() <= 1e-11 * size) {
        converged = true;
      } else {
        const Eigen::VectorXd change = tangent.partialPivLu().solve(-residual);
        for (int i = 0; i < n; ++i) u[at(i)] += change(i);
      }
    }
    solution.iterations.push_back(iterations);
    if (!converged) {
      ++solution.cuts;
      step *= cut;
      if (step < 1e-6) throw std::runtime_error("the step was cut too often");
      continue;
    }
    host.accept();
    accepted = u;
    load = next;
    solution.displacement.insert(solution.displacement.end(), u.begin(), u.end());
  }
  return solution;
}

} // namespace adapters
