// SPDX-License-Identifier: BSD-3-Clause
// What the patched ccx calls in libents_calculix.so, with the length of `lakon` last, as Fortran passes it.
#pragma once

#include <cstddef>

extern "C" {
void ents_ccx_stiffness_(const int* nelem, const char* lakonl, double* s, double* sm, double* ff,
                         std::size_t);
void ents_ccx_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl, const double* co,
                     const double* v, const double* vini, const int* mi, const int* ielprop,
                     const double* prop, double* fn, double* qa, int* nal, const int* calcul_fn,
                     const int* calcul_qa, const double* xstateini, double* xstate, const int* nstate_,
                     const double* dtime, std::size_t);
void ents_ccx_uel_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                         const double* co, const double* v, const double* vini, const int* mi,
                         const int* ielprop, const double* prop, double* fn, double* qa, int* nal,
                         const int* calcul_fn, const int* calcul_qa, const double* xstateini, double* xstate,
                         const int* nstate_, const double* time, const double* ttime, const double* dtime,
                         const int* istep, const int* iinc, std::size_t);
int ents_ccx_uel_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                              const double* prop);
int ents_ccx_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                          const double* prop, const int* nprop);
void ents_ccx_find_heat_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                         const double* prop, const int* nprop, const int* ithermal, std::size_t);
int ents_ccx_has_heat_(const int* index);
void ents_ccx_heat_stiffness_(const int* nelem, int* nope, double* s, double* sm, double* ff);
void ents_ccx_linear_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                            const double* vold, const double* v, const int* mi, double* fn,
                            const int* calcul_fn, std::size_t);
void ents_ccx_heat_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                          const double* co, const double* v, const int* mi, const int* ielprop,
                          const double* prop, double* fn, double* qa, int* nal, const int* calcul_fn,
                          const int* calcul_qa, const double* xstateini, const int* nstate_,
                          const double* dtime, const int* ithermal, const int* nmethod, std::size_t);
}
