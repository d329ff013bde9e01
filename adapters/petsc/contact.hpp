// SPDX-License-Identifier: BSD-3-Clause
// The recipe of README.md: contact of surfaces that are distributed over the processes of PETSC_COMM_WORLD. No
// process knows a surface as a whole: it gives the slave nodes and the master facets that it owns, and takes
// as ghosts the facets of its neighbours that its slave nodes may touch. Segments are quad4; s is x, y of the
// undeformed mesh.
#pragma once
#include <petscmat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "ents.hpp"

#define ENTS_PETSC(...) PetscCallAbort(PETSC_COMM_WORLD, __VA_ARGS__) // a process that fails ends all

namespace ents_petsc {

using std::size_t;
using Numbers = std::vector<double>;

struct Nodes {                   // whose displacements come from their owners
  std::vector<PetscInt> numbers; // among all processes: rows 3 n .. 3 n + 2
  Numbers start, now, begin;     // [nodes][3] positions: undeformed, present, at the begin of the increment
  Vec local = nullptr;
  VecScatter scatter = nullptr;

  Nodes() = default;
  Nodes(const Nodes&) = delete;
  Nodes& operator=(const Nodes&) = delete;
  ~Nodes() {
    VecDestroy(&local);
    VecScatterDestroy(&scatter);
  }
  void connect(Vec x) { // collective
    IS from = nullptr;
    ENTS_PETSC(VecDestroy(&local));
    ENTS_PETSC(VecScatterDestroy(&scatter));
    ENTS_PETSC(ISCreateBlock(PETSC_COMM_SELF, 3, PetscInt(numbers.size()), numbers.data(), PETSC_COPY_VALUES,
                             &from));
    ENTS_PETSC(VecCreateSeq(PETSC_COMM_SELF, PetscInt(start.size()), &local));
    ENTS_PETSC(VecScatterCreate(x, from, local, nullptr, &scatter));
    ENTS_PETSC(ISDestroy(&from));
  }
  void fetch(Vec x, Numbers& positions) { // collective: messages between neighbours
    const double* u = nullptr;
    ENTS_PETSC(VecScatterBegin(scatter, x, local, INSERT_VALUES, SCATTER_FORWARD));
    ENTS_PETSC(VecScatterEnd(scatter, x, local, INSERT_VALUES, SCATTER_FORWARD));
    ENTS_PETSC(VecGetArrayRead(local, &u));
    positions = start;
    for (size_t i = 0; i < start.size(); ++i) positions[i] += u[i];
    ENTS_PETSC(VecRestoreArrayRead(local, &u));
  }
};

struct Facet { // as it is sent: numbers among all processes, undeformed positions
  double number, nodes[4], x[4][3];
};

struct Facets : Nodes {
  std::vector<Facet> all;
  std::vector<int64_t> connectivity; // [facets][4] places in `numbers`
  Numbers coordinates;               // [facets][4][2]: s is x, y of the undeformed mesh

  void renew(Vec x) { // after a change of `all`; collective
    std::set<PetscInt> found;
    for (const Facet& f : all) found.insert(f.nodes, f.nodes + 4);
    numbers.assign(found.begin(), found.end()), start.resize(3 * numbers.size()), connectivity.clear(),
        coordinates.clear();
    for (const Facet& f : all)
      for (int i = 0; i < 4; ++i) {
        connectivity.push_back(std::lower_bound(numbers.begin(), numbers.end(), PetscInt(f.nodes[i])) -
                               numbers.begin());
        std::copy(f.x[i], f.x[i] + 3, start.begin() + 3 * connectivity.back());
        coordinates.insert(coordinates.end(), f.x[i], f.x[i] + 2);
      }
    connect(x);
  }
  ents_master_mesh mesh(const Numbers& positions) const {
    auto view = ents::make<ents_master_mesh>();
    view.segments = int64_t(all.size()), view.connectivity = connectivity.data(),
    view.nodes = int64_t(numbers.size());
    view.positions = positions.data(), view.surface_coordinates = coordinates.data();
    return view;
  }
};

struct Box {
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  void include(const double* a, const double* b) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], a[k]), high[k] = std::max(high[k], b[k]);
  }
  bool near(const Box& other, double distance) const { // the same bits on both processes
    bool yes = true;
    for (int k = 0; k < 3; ++k)
      yes = yes && std::max(low[k] - other.high[k], other.low[k] - high[k]) <= distance;
    return yes;
  }
};

// What each process gives before initialise(): slave.numbers, slave.start, area [A]; own.all.
struct Contact {
  const ents::Model model;
  const double reach;  // [L] of ents_detection
  const double margin; // [L] ghosts are taken within reach + margin, and kept until something moved by margin
  Nodes slave;         // of this process, with their tributary areas
  Numbers area;
  Facets own, near; // master facets that this process gives; those that its slave nodes may touch
  int searches = 0;

  Contact(const char* text, double reach_, double margin_) : model(text), reach(reach_), margin(margin_) {}
  void initialise(Vec x) { // x: where friction begins
    const size_t n = area.size();
    states = ents::States(model, int64_t(n));
    segment.assign(n, -1), xi.resize(2 * n), gap.resize(n), residual.resize(15 * n), tangent.resize(225 * n);
    slave.connect(x), own.renew(x), near.renew(x), accept(x);
  }
  void accept(Vec x) { // the increment has converged
    states.accept();
    segment_begin = segment, xi_begin = xi;
    slave.fetch(x, slave.begin), own.fetch(x, own.begin), near.fetch(x, near.begin);
  }
  void reject() { segment = segment_begin, xi = xi_begin, gap.assign(gap.size(), 0.0); } // it is thrown away

  // Adds the contact forces at displacements x to r. false, on all processes: take a smaller increment.
  bool forces(Vec x, Vec x_begin, Vec r) {
    slave.fetch(x, slave.now), own.fetch(x, own.now);
    double moved[2] = {farthest(slave.now, searched), farthest(own.now, searched_master)};
    MPI_Allreduce(MPI_IN_PLACE, moved, 2, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
    if (searches == 0 || moved[0] + 2 * moved[1] > margin)
      search(x, x_begin); // 2: facets that turn move their height
    near.fetch(x, near.now);
    int cut = !area.empty() && !near.all.empty() && !iterate();
    MPI_Allreduce(MPI_IN_PLACE, &cut, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
    for (size_t i = 0; i < area.size() && cut == 0; ++i)
      if (segment[i] >= 0)
        ENTS_PETSC(VecSetValuesBlocked(r, 5, element(i).data(), &residual[15 * i], ADD_VALUES));
    return cut == 0;
  }
  void add_tangent(Mat bodies, Mat* sum) const { // of the last displacements; *sum is new
    std::vector<PetscInt> rows, columns;
    Numbers values;
    for (size_t i = 0; i < area.size(); ++i) {
      if (segment[i] < 0) continue;
      const auto nodes = element(i);
      for (size_t e = 0; e < 225; ++e) { // column by column
        rows.push_back(3 * nodes[e % 15 / 3] + PetscInt(e % 3));
        columns.push_back(3 * nodes[e / 45] + PetscInt(e / 15 % 3));
        values.push_back(tangent[225 * i + e]);
      }
    }
    Mat contact = nullptr;
    PetscInt size = 0;
    ENTS_PETSC(MatGetLocalSize(bodies, &size, nullptr));
    ENTS_PETSC(MatCreateAIJ(PETSC_COMM_WORLD, size, size, PETSC_DECIDE, PETSC_DECIDE, 0, nullptr, 0, nullptr,
                            &contact));
    ENTS_PETSC(MatSetPreallocationCOO(contact, PetscCount(values.size()), rows.data(), columns.data()));
    ENTS_PETSC(MatSetValuesCOO(contact, values.data(), INSERT_VALUES));
    ENTS_PETSC(MatDuplicate(bodies, MAT_COPY_VALUES, sum));
    ENTS_PETSC(MatAXPY(*sum, 1.0, contact, DIFFERENT_NONZERO_PATTERN));
    ENTS_PETSC(MatDestroy(&contact));
  }

private:
  Numbers searched, searched_master;           // positions at the last search
  std::set<double> known;                      // numbers of the facets in `near`
  std::vector<int64_t> segment, segment_begin; // of each slave node: a facet of `near`, or -1
  Numbers xi, xi_begin, gap, residual, tangent;
  ents::States states;
  ents::Tree tree;

  std::array<PetscInt, 5> element(size_t i) const { // numbers of the slave node and of the master nodes
    std::array<PetscInt, 5> nodes = {slave.numbers[i]};
    for (size_t m = 0; m < 4; ++m)
      nodes[1 + m] = near.numbers[size_t(near.connectivity[4 * size_t(segment[i]) + m])];
    return nodes;
  }
  static double farthest(const Numbers& a, const Numbers& b) {
    double most = 0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); i += 3)
      most = std::max(most, std::hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
    return most;
  }
  // Every process tells all others two boxes; then it sends its facets to those whose slave nodes are near.
  void search(Vec x, Vec x_begin) {
    int processes = 0;
    MPI_Comm_size(PETSC_COMM_WORLD, &processes);
    Box mine[2]; // slave nodes on their way from the begin of the increment; master facets
    for (const Numbers* points : {&slave.begin, &slave.now})
      for (size_t i = 0; i < points->size(); i += 3) mine[0].include(&(*points)[i], &(*points)[i]);
    std::vector<Box> boxes(own.all.size()), all(2 * static_cast<size_t>(processes));
    const ents_master_mesh mesh = own.mesh(own.now);
    ents::require(ents::linked(), ents_surface_boxes, model.get(), &mesh,
                  boxes.empty() ? nullptr : boxes[0].low);
    for (const Box& box : boxes) mine[1].include(box.low, box.high);
    MPI_Allgather(mine, 12, MPI_DOUBLE, all.data(), 12, MPI_DOUBLE, PETSC_COMM_WORLD);
    std::vector<std::vector<Facet>> given(all.size() / 2);
    std::vector<MPI_Request> requests;
    for (size_t to = 0; to < given.size(); ++to) {
      if (!all[2 * to].near(mine[1], reach + margin)) continue;
      for (size_t f = 0; f < boxes.size(); ++f)
        if (all[2 * to].near(boxes[f], reach + margin)) given[to].push_back(own.all[f]);
      requests.emplace_back();
      MPI_Isend(given[to].data(), int(17 * given[to].size()), MPI_DOUBLE, int(to), 0, PETSC_COMM_WORLD,
                &requests.back());
    }
    for (size_t from = 0; from < given.size(); ++from) {
      if (!mine[0].near(all[2 * from + 1], reach + margin)) continue;
      MPI_Status status = {};
      int count = 0;
      MPI_Probe(int(from), 0, PETSC_COMM_WORLD, &status);
      MPI_Get_count(&status, MPI_DOUBLE, &count);
      std::vector<Facet> got(size_t(count / 17));
      MPI_Recv(got.data(), count, MPI_DOUBLE, int(from), 0, PETSC_COMM_WORLD, &status);
      for (const Facet& facet : got) // an old one keeps its place: states know those of their segments
        if (known.insert(facet.number).second) near.all.push_back(facet);
    }
    MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    near.renew(x), near.fetch(x_begin, near.begin), near.fetch(x, near.now);
    if (!near.all.empty()) tree = ents::Tree(model, near.mesh(near.now));
    searched = slave.now, searched_master = own.now, ++searches;
  }
  bool iterate() { // on this process alone
    const ents_master_mesh mesh = near.mesh(near.now);
    tree.refit(model, mesh);
    for (size_t i = 0; i < area.size(); ++i)
      if (gap[i] > 0) segment[i] = -1; // open ones look at all facets
    auto found = ents::make<ents_detection>();
    found.slave = slave.now.data(), found.reach = reach;
    found.segment = segment.data(), found.xi = xi.data(), found.gap = gap.data();
    auto input = ents::make<ents_input>();
    input.area = area.data(), input.area_stride = 1;
    input.state_begin = states.begin.data(), input.state_begin_stride = states.size;
    input.slave_begin = slave.begin.data(), input.positions_begin = near.begin.data();
    auto output = ents::make<ents_output>();
    output.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE;
    output.residual = residual.data(), output.residual_stride = 15;
    output.tangent = tangent.data(), output.tangent_stride = 225;
    output.state_end = states.end.data(), output.state_end_stride = states.size;
    return ents::call(ents_iterate, model.get(), &mesh, tree.data(), tree.size(), int64_t{0},
                      int64_t(area.size()), &found, &input, &output, nullptr)
        .ok();
  }
};

} // namespace ents_petsc
