#include "calculix.hpp"

#include <algorithm>
#include <cstddef>

namespace bench {

#ifdef ENTS_BENCH_CALCULIX

// Argument names as in ccx; the last one is the length of lakonl. Default integers and real*8.
extern "C" {
void springforc_n2f_(double* xl, int* konl, double* vl, int* imat, double* elcon, int* nelcon, double* elas,
                     double* fnl, int* ncmat, int* ntmat, int* nope, char* lakonl, double* t1l, int* kode,
                     double* elconloc, double* plicon, int* nplicon, int* npmat, double* senergy, int* nener,
                     double* cstr, int* mi, double* springarea, int* nmethod, int* ne0, int* nstate,
                     double* xstateini, double* xstate, double* reltime, int* ielas, double* venergy,
                     int* ielorien, double* orab, int* norien, int* nelem, double* smscale, int* mscalmethod,
                     std::size_t);
void springstiff_n2f_(double* xl, double* elas, int* konl, double* voldl, double* s, int* imat, double* elcon,
                      int* nelcon, int* ncmat, int* ntmat, int* nope, char* lakonl, double* t1l, int* kode,
                      double* elconloc, double* plicon, int* nplicon, int* npmat, int* iperturb,
                      double* springarea, int* nmethod, int* mi, int* ne0, int* nstate, double* xstateini,
                      double* xstate, double* reltime, int* nasym, int* ielorien, double* orab, int* norien,
                      int* nelem, std::size_t);
}

bool CalculixSpring::available() { return true; }

void CalculixSpring::run() {
  int konl[20] = {2, 3, 4, 5, 1, 1}; // the sixth: number of the spring
  int imat = 1, nelcon[2] = {-51, 1}, ncmat = 7, ntmat = 1, nope = 5, kode = -51, nplicon[2] = {}, npmat = 1,
      nener = 0;
  int mi[3] = {1, 3, 1}, nmethod = 1, ne0 = 0, nstate = 9, ielas = 0, ielorien[3] = {}, norien = 0, nelem = 1,
      mscalmethod = 0;
  int iperturb[2] = {2, 1};
  double elas[21] = {}, t1l = 0.0, elconloc[21] = {}, plicon[3] = {}, senergy = 0.0, cstr[6], reltime = 1.0,
         venergy = 0.0, orab[7] = {}, smscale = 1.0;
  char lakonl[] = "ESPRNGC4";
  springforc_n2f_(positions_.data(), konl, displacements_.data(), &imat, law_.data(), nelcon, elas,
                  force_.data(), &ncmat, &ntmat, &nope, lakonl, &t1l, &kode, elconloc, plicon, nplicon,
                  &npmat, &senergy, &nener, cstr, mi, area_.data(), &nmethod, &ne0, &nstate,
                  state_begin_.data(), state_end_.data(), &reltime, &ielas, &venergy, ielorien, orab, &norien,
                  &nelem, &smscale, &mscalmethod, 8);
  springstiff_n2f_(positions_.data(), elas, konl, displacements_.data(), stiffness_.data(), &imat,
                   law_.data(), nelcon, &ncmat, &ntmat, &nope, lakonl, &t1l, &kode, elconloc, plicon, nplicon,
                   &npmat, iperturb, area_.data(), &nmethod, mi, &ne0, &nstate, state_begin_.data(),
                   state_end_.data(), &reltime, &unsymmetric_, ielorien, orab, &norien, &nelem, 8);
}

#else

bool CalculixSpring::available() { return false; }
void CalculixSpring::run() {}

#endif

CalculixSpring::CalculixSpring(const double* slave, const double* master, double area, double stiffness,
                               const double* slip, double coefficient, double shear_stiffness) {
  std::copy_n(master, 12, positions_.begin());
  for (std::size_t c = 0; c < 3; ++c) {
    positions_[12 + c] = slave[c] - slip[c];
    displacements_[4 * 4 + c + 1] = slip[c];
  }
  // linear overclosure; its pressure at zero clearance so small that it is a penalty: relative 1e-9 at a gap
  // of 1e-3
  law_[1] = 1e-12 * stiffness;
  law_[2] = stiffness;
  law_[3] = 2.0;
  law_[6] = coefficient;
  law_[7] = shear_stiffness;
  area_[0] = area;
  unsymmetric_ = coefficient > 0.0 ? 1 : 0;
}

} // namespace bench
