// SPDX-License-Identifier: BSD-3-Clause
// The VTU series of a run that goes on after it was stopped.
#pragma once

#include "toolbox/vtu.hpp"

namespace host {

/// What the .pvd file there is says of earlier steps stays in it.
void resume(vtu::Series& series, int first_step);

/// Steps of which the .pvd file lists as many parts as of any, ascending.
std::vector<int> whole_steps(const vtu::Series& series);

} // namespace host
