// SPDX-License-Identifier: BSD-3-Clause
// Two elastic sheets on springs, on any number of MPI processes: the upper one is pressed on the lower one, whose
// waves are finer than its mesh, and slides over it with friction. The program that shows contact.hpp.
#include <petscksp.h>

#include <cstdio>
#include <stdexcept>

#include "contact.hpp"

static char help[] = // PETSc's, which takes no const
    "usage: mpirun -n P petsc_sheets [-n N] [-steps N] [-margin L] [PETSc's options: -ksp_type, -pc_type, "
    "...]\n"
    "  -n N       the lower sheet has 12 N x 8 N facets, the upper one 7 N x 7 N; default 1\n"
    "  -steps N   increments; one without convergence is halved; default 10\n"
    "  -margin L  ghosts are searched anew when the surfaces have approached by this length; default 0.15\n"
    "exit status: 0 done; not 0: a mistake, or no convergence\n\n";

namespace {

using ents_petsc::Facet;
int process = 0, processes = 1;

struct Sheet { // a grid of nodes, cut into strips along x
  PetscInt n[2];
  double low[3], size[2];
  PetscInt first(int rank) const { return (n[0] + 1) * rank / processes; }
  PetscInt count(int rank) const { return (first(rank + 1) - first(rank)) * (n[1] + 1); }
  double spacing(int axis) const { return size[axis] / double(n[axis]); }
} sheets[2];

// A node's number among all processes; those of a process are consecutive, the lower sheet's first.
PetscInt number(int sheet, PetscInt i, PetscInt j) {
  const Sheet& s = sheets[sheet];
  const int owner = int(((i + 1) * processes - 1) / (s.n[0] + 1));
  PetscInt before = sheet == 1 ? sheets[0].count(owner) : 0;
  for (const Sheet& each : sheets) before += each.first(owner) * (each.n[1] + 1);
  return before + (i - s.first(owner)) * (s.n[1] + 1) + j;
}

// The springs of the nodes of this process in k and (those to the base) bed, and what it gives to the contact.
void build(Mat k, Vec bed, ents_petsc::Contact& contact) {
  for (int b = 0; b < 2; ++b) {
    const Sheet& s = sheets[b];
    const auto spring = [k](PetscInt from, PetscInt to, double stiffness) {
      for (PetscInt a = 0; a < 3; ++a) {
        const PetscInt rows[2] = {3 * from + a, 3 * to + a};
        const double values[4] = {stiffness, -stiffness, -stiffness, stiffness};
        ENTS_PETSC(MatSetValues(k, from == to ? 1 : 2, rows, from == to ? 1 : 2, rows, values, ADD_VALUES));
      }
    };
    for (PetscInt i = s.first(process); i < s.first(process + 1); ++i)
      for (PetscInt j = 0; j <= s.n[1]; ++j) {
        const auto half = [](PetscInt at, PetscInt n) { return at == 0 || at == n ? 0.5 : 1.0; };
        const double area = s.spacing(0) * s.spacing(1) * half(i, s.n[0]) * half(j, s.n[1]);
        const PetscInt me = number(b, i, j), rows[3] = {3 * me, 3 * me + 1, 3 * me + 2};
        const double base[3] = {500 * area, 500 * area, 1000 * area};
        ENTS_PETSC(VecSetValues(bed, 3, rows, base, INSERT_VALUES));
        for (int a = 0; a < 3; ++a) ENTS_PETSC(MatSetValue(k, rows[a], rows[a], base[a], ADD_VALUES));
        if (i < s.n[0]) spring(me, number(b, i + 1, j), 50.0);
        if (j < s.n[1]) spring(me, number(b, i, j + 1), 50.0);
        const auto place = [&s](PetscInt p, PetscInt q) {
          return std::array<double, 3>{s.low[0] + s.spacing(0) * double(p),
                                       s.low[1] + s.spacing(1) * double(q), s.low[2]};
        };
        if (b == 1) {
          contact.slave.numbers.push_back(me), contact.area.push_back(area);
          for (const double x : place(i, j)) contact.slave.start.push_back(x);
        } else if (i < s.n[0] && j < s.n[1]) { // the normal of a facet is +z
          Facet facet = {double(i * s.n[1] + j), {}, {}};
          const PetscInt corners[4][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
          for (int c = 0; c < 4; ++c) {
            facet.nodes[c] = double(number(b, corners[c][0], corners[c][1]));
            const auto x = place(corners[c][0], corners[c][1]);
            std::copy(x.begin(), x.end(), facet.x[c]);
          }
          contact.own.all.push_back(facet);
        }
      }
  }
  ENTS_PETSC(MatAssemblyBegin(k, MAT_FINAL_ASSEMBLY));
  ENTS_PETSC(MatAssemblyEnd(k, MAT_FINAL_ASSEMBLY));
  ENTS_PETSC(VecAssemblyBegin(bed));
  ENTS_PETSC(VecAssemblyEnd(bed));
}

// Newton's iteration. x_begin: at the begin of the increment; load: forces of the springs' moving ends.
bool solve(ents_petsc::Contact& contact, Mat k, KSP ksp, Vec load, Vec x_begin, Vec x, int& iterations) {
  Vec r = nullptr, step = nullptr;
  ENTS_PETSC(VecDuplicate(x, &r));
  ENTS_PETSC(VecDuplicate(x, &step));
  double norm = 1;
  for (iterations = 0; iterations < 30; ++iterations) {
    ENTS_PETSC(MatMult(k, x, r));
    ENTS_PETSC(VecAXPY(r, -1.0, load));
    if (!contact.forces(x, x_begin, r)) break;
    ENTS_PETSC(VecAssemblyBegin(r));
    ENTS_PETSC(VecAssemblyEnd(r));
    ENTS_PETSC(VecNorm(r, NORM_2, &norm));
    if (norm < 1e-11) break;
    Mat tangent = nullptr;
    contact.add_tangent(k, &tangent);
    ENTS_PETSC(KSPSetOperators(ksp, tangent, tangent));
    ENTS_PETSC(KSPSolve(ksp, r, step));
    ENTS_PETSC(VecAXPY(x, -1.0, step));
    ENTS_PETSC(MatDestroy(&tangent));
  }
  ENTS_PETSC(VecDestroy(&r));
  ENTS_PETSC(VecDestroy(&step));
  return norm < 1e-11;
}

void run() {
  PetscInt refine = 1, steps = 10;
  double margin = 0.15;
  ENTS_PETSC(PetscOptionsGetInt(nullptr, nullptr, "-n", &refine, nullptr));
  ENTS_PETSC(PetscOptionsGetInt(nullptr, nullptr, "-steps", &steps, nullptr));
  ENTS_PETSC(PetscOptionsGetReal(nullptr, nullptr, "-margin", &margin, nullptr));
  MPI_Comm_rank(PETSC_COMM_WORLD, &process);
  MPI_Comm_size(PETSC_COMM_WORLD, &processes);
  if (refine < 1 || steps < 1 || !(margin > 0))
    throw std::invalid_argument("-n and -steps are at least 1, -margin is above 0");
  sheets[0] = {{12 * refine, 8 * refine}, {0.0, 0.0, 0.0}, {3.0, 2.0}};
  sheets[1] = {{7 * refine, 7 * refine}, {0.55, 0.4, 0.01}, {1.2, 1.2}};
  ents_petsc::Contact contact(R"({"segment": "quad4", "border": 1e-5,
    "height": {"type": "product", "of": [{"type": "sine", "amplitude": 0.004, "wave_vector": [5.3, 0]},
                                         {"type": "sine", "amplitude": 1, "wave_vector": [0, 4.1]}]},
    "contact": {"normal": {"type": "penalty", "stiffness": 2e4},
                "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 4e3}}})",
                              0.1, margin);
  Mat k = nullptr;
  Vec x = nullptr, x_begin = nullptr, bed = nullptr, base = nullptr, load = nullptr;
  KSP ksp = nullptr;
  const PetscInt size = 3 * (sheets[0].count(process) + sheets[1].count(process)),
                 lower = 3 * sheets[0].count(process);
  ENTS_PETSC(
      MatCreateAIJ(PETSC_COMM_WORLD, size, size, PETSC_DECIDE, PETSC_DECIDE, 5, nullptr, 2, nullptr, &k));
  ENTS_PETSC(MatCreateVecs(k, nullptr, &x));
  ENTS_PETSC(VecSetBlockSize(x, 3));
  for (Vec* each : {&x_begin, &bed, &base, &load}) ENTS_PETSC(VecDuplicate(x, each));
  ENTS_PETSC(KSPCreate(PETSC_COMM_WORLD, &ksp));
  ENTS_PETSC(KSPSetTolerances(ksp, 1e-9, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
  ENTS_PETSC(KSPSetFromOptions(ksp));
  build(k, bed, contact);
  contact.initialise(x);

  double part = 1.0 / double(steps);
  for (double time = 0; time < 1 - 1e-9;) { // pressed in the first fifth, then slides
    const double end = std::min(time + part, 1.0),
                 shift[3] = {std::max(0.0, 0.875 * (end - 0.2)), 0.0, -0.03 * std::min(1.0, 5 * end)};
    double* u = nullptr;
    ENTS_PETSC(VecGetArray(base, &u));
    for (PetscInt i = lower; i < size; ++i) u[i] = shift[i % 3];
    ENTS_PETSC(VecRestoreArray(base, &u));
    ENTS_PETSC(VecPointwiseMult(load, bed, base));
    int iterations = 0;
    if (!solve(contact, k, ksp, load, x_begin, x, iterations)) {
      contact.reject();
      ENTS_PETSC(VecCopy(x_begin, x));
      if ((part /= 2) < 1e-3 / double(steps))
        throw std::runtime_error("no convergence, even in small increments");
      continue;
    }
    contact.accept(x);
    ENTS_PETSC(VecCopy(x, x_begin));
    time = end;
    double force[3] = {0, 0, 0}; // of the springs below the lower sheet
    ENTS_PETSC(VecPointwiseMult(load, bed, x));
    ENTS_PETSC(VecGetArray(load, &u));
    for (PetscInt i = 0; i < lower; ++i) force[i % 3] += u[i];
    ENTS_PETSC(VecRestoreArray(load, &u));
    MPI_Allreduce(MPI_IN_PLACE, force, 3, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    ENTS_PETSC(PetscPrintf(PETSC_COMM_WORLD, "time %.6f  Newton %2d  force %+.12f %+.12f %+.12f\n", time,
                           iterations, force[0], force[1], force[2]));
  }
  PetscInt most[3] = {PetscInt(contact.area.size()), PetscInt(contact.own.all.size()),
                      PetscInt(contact.near.all.size())};
  MPI_Allreduce(MPI_IN_PLACE, most, 3, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD);
  ENTS_PETSC(PetscPrintf(PETSC_COMM_WORLD,
                         "largest of a process: slave nodes %d, facets of its own %d, facets near its slave "
                         "nodes %d; searches %d\n",
                         int(most[0]), int(most[1]), int(most[2]), contact.searches));
  for (Vec* each : {&x, &x_begin, &bed, &base, &load}) ENTS_PETSC(VecDestroy(each));
  ENTS_PETSC(MatDestroy(&k));
  ENTS_PETSC(KSPDestroy(&ksp));
}

} // namespace

int main(int argc, char** argv) {
  ENTS_PETSC(PetscInitialize(&argc, &argv, nullptr, help));
  try {
    run();
  } catch (const std::exception& error) { // the others would wait for this process
    std::fprintf(stderr, "petsc_sheets: process %d: %s\n", process, error.what());
    MPI_Abort(PETSC_COMM_WORLD, 1);
  }
  return int(PetscFinalize());
}
