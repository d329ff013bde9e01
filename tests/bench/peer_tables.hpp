// The tables of ents-bench --peers, one for each program that is compared with.
#pragma once

#include <functional>
#include <iosfwd>

#include "cases.hpp"

namespace bench {

// False if the forces are not those of the library.
bool print_calculix(std::ostream& out);
bool print_ipc(std::ostream& out);

// "compiled for this machine", or not
extern const char peers_compiled[];

// Above the rows: times of the library in single calls and in calls of 64, of the peer, and the ratios.
void print_peer_head(std::ostream& out, const char* peer);
void print_peer_row(std::ostream& out, const std::string& name, double single, double of_64, double theirs);

// One pass over all elements of a job
std::function<void()> calls(Job& job);

} // namespace bench
