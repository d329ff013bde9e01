// SPDX-License-Identifier: BSD-3-Clause
// Emulated hosts with one user element each; each .cpp file says what its host passes.
#pragma once

#include <memory>

#include "emulated_host.hpp"

namespace adapters {

std::unique_ptr<EmulatedHost>
vuel_host(const Elements& elements); ///< Abaqus/Explicit; stiffness of the plain interface
std::unique_ptr<EmulatedHost>
opensees_host(const Elements& elements); ///< C element with the host's own functions
std::unique_ptr<EmulatedHost>
opensees_frame_host(const Elements& elements); ///< nodes with 0, 1 or 2 more degrees of freedom
std::unique_ptr<EmulatedHost> feap_host(const Elements& elements);  ///< elmt07 with FEAP's common blocks
std::unique_ptr<EmulatedHost> ansys_host(const Elements& elements); ///< UserElem
std::unique_ptr<EmulatedHost> marc_host(const Elements& elements);  ///< USELEM
std::unique_ptr<EmulatedHost>
marc_user_code_host(const Elements& elements); ///< USELEM, displacements and signs of public user code
std::unique_ptr<EmulatedHost> lsdyna_host(const Elements& elements); ///< usld_e101

} // namespace adapters
