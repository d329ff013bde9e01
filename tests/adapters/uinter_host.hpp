// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Standard as it calls UINTER, emulated: one point of its contact, with both argument lists.
#pragma once

#include <cstddef>
#include <cstring>

#include "guarded.hpp"

extern "C" {
using Real = double*;
using Text = char*;
using Whole = int*;
void uinter_(Real stress, Real ddsddr, Real dviscous, Real dstructural, Real flux, Real ddfddt, Real ddsddt,
             Real ddfddr, Real statev, Real sed, Real sfd, Real spd, Real svd, Real scd, Real pnewdt,
             Real rdisp, Real drdisp, Real temp, Real dtemp, Real predef, Real dpred, Real time, Real dtime,
             Real freqr, Text ciname, Text secname, Text mainname, Real props, Real coords, Real alocaldir,
             Real drot, Real area, Real chrlngth, Whole node, Whole ndir, Whole nstatv, Whole npred,
             Whole nprops, Whole mcrd, Whole kstep, Whole kinc, Whole kit, Whole linper, Whole lopenclose,
             Whole lstate, Whole lsdi, Whole lprint, std::size_t, std::size_t, std::size_t);
using Uinter47 = decltype(uinter_);
using Uinter44 = void(Real stress, Real ddsddr, Real flux, Real ddfddt, Real ddsddt, Real ddfddr, Real statev,
                      Real sed, Real sfd, Real spd, Real svd, Real scd, Real pnewdt, Real rdisp, Real drdisp,
                      Real temp, Real dtemp, Real predef, Real dpred, Real time, Real dtime, Text ciname,
                      Text slname, Text msname, Real props, Real coords, Real alocaldir, Real drot, Real area,
                      Real chrlngth, Whole node, Whole ndir, Whole nstatv, Whole npred, Whole nprops,
                      Whole mcrd, Whole kstep, Whole kinc, Whole kit, Whole linper, Whole lopenclose,
                      Whole lstate, Whole lsdi, Whole lprint, std::size_t, std::size_t, std::size_t);
}

namespace adapters {

/// One point; outputs poisoned, guard zones. Its master surface is inclined; the slip directions start at
/// known coordinates.
struct UinterCall {
  explicit UinterCall(int directions) : ndir(directions) {
    for (std::size_t i = 0; i < statev.size(); ++i) statev[i] = 0;
    const double c = 0.8, s = 0.6;
    const double plane[9] = {-s, c, 0, c, s, 0, 0, 0, 1}, space[9] = {-s, 0, c, c, 0, s, 0, 1, 0};
    std::memcpy(alocaldir, directions == 2 ? plane : space, sizeof alocaldir);
  }

  int ndir, mcrd = ndir, nstatv = 20, node = 17, linper = 0, lopenclose = -1, nprops = 2;
  Guarded stress{3}, ddsddr{9}, dviscous{9}, dstructural{9}, flux{2}, ddfddt{4}, ddsddt{6}, ddfddr{6},
      statev{20}, sed{1}, sfd{1};
  double pnewdt = 1e36, rdisp[3] = {}, drdisp[3] = {}, temp[2] = {}, dtime = 1, coords[3] = {}, alocaldir[9],
         props[3] = {61, 2, 0};

  /// Surface coordinates of the point, which has slipped by rdisp since it was there.
  void place(double s1, double s2) {
    const double at[2] = {s1 + rdisp[1], s2 + rdisp[2]};
    for (int i = 0; i < 3; ++i) {
      coords[i] = 0;
      for (int a = 0; a + 1 < ndir; ++a) coords[i] += at[a] * alocaldir[i + 3 * (1 + a)];
    }
  }

  void operator()(Uinter44* old = nullptr, Uinter47* now = uinter_) {
    double still[12] = {}, time[2] = {1, 1}, one = 1;
    int npred = 0, step = 1, lstate = -1, lsdi = 0, lprint = 0;
    char name[81] = "ENTS                                                                            ";
    if (old)
      old(stress.data(), ddsddr.data(), flux.data(), ddfddt.data(), ddsddt.data(), ddfddr.data(),
          statev.data(), sed.data(), sfd.data(), still, still, still, &pnewdt, rdisp, drdisp, temp, still,
          still, still, time, &dtime, name, name, name, props, coords, alocaldir, still, &one, &one, &node,
          &ndir, &nstatv, &npred, &nprops, &mcrd, &step, &step, &step, &linper, &lopenclose, &lstate, &lsdi,
          &lprint, 80, 80, 80);
    else
      now(stress.data(), ddsddr.data(), dviscous.data(), dstructural.data(), flux.data(), ddfddt.data(),
          ddsddt.data(), ddfddr.data(), statev.data(), sed.data(), sfd.data(), still, still, still, &pnewdt,
          rdisp, drdisp, temp, still, still, still, time, &dtime, &one, name, name, name, props, coords,
          alocaldir, still, &one, &one, &node, &ndir, &nstatv, &npred, &nprops, &mcrd, &step, &step, &step,
          &linper, &lopenclose, &lstate, &lsdi, &lprint, 80, 80, 80);
    for (const Guarded* array :
         {&stress, &ddsddr, &flux, &ddfddt, &ddsddt, &ddfddr, &statev, &sed, &sfd, &dviscous, &dstructural})
      array->check_guards("an array");
    const auto d = static_cast<std::size_t>(ndir);
    stress.check_written("STRESS", 0, d), ddsddr.check_written("DDSDDR", 0, d * d),
        flux.check_written("FLUX", 0, 2);
    ddfddt.check_written("DDFDDT", 0, 4), ddsddt.check_written("DDSDDT", 0, 2 * d),
        ddfddr.check_written("DDFDDR", 0, 2 * d), sfd.check_written("SFD", 0, 1);
    if (!old)
      dviscous.check_written("DVISCOUS", 0, d * d), dstructural.check_written("DSTRUCTURAL", 0, d * d);
  }
};

} // namespace adapters
