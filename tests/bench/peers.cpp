#include "peers.hpp"

#include <iomanip>
#include <ostream>
#include <string>

#include "calculix.hpp"
#include "ipc_pair.hpp"
#include "peer_tables.hpp"

namespace bench {

#ifdef ENTS_BENCH_NATIVE
const char peers_compiled[] = "compiled for this machine";
#else
const char peers_compiled[] = "compiled for any machine of its kind";
#endif

namespace {

constexpr char how_to_get_calculix[] =
    R"help(CalculiX is not in this program. Its routines springforc_n2f and springstiff_n2f (GPL, not part of this project) are built in when
CMake is told where the sources of ccx are:
  sh adapters/calculix/run.sh --only-build     (or: apt-get source calculix-ccx)
  cmake -S . -B build -DENTS_CCX_SOURCE="$(dirname "$(find build/calculix -name springforc_n2f.f)")"
  cmake --build build --target ents-bench
)help";

constexpr char how_to_get_ipc[] =
    R"help(The IPC Toolkit is not in this program. Its barrier and friction potentials (MIT, not part of this project) are built in when CMake is
told where a checkout is; they need Eigen and the headers of TBB (libeigen3-dev, libtbb-dev):
  git clone https://github.com/ipc-sim/ipc-toolkit && git -C ipc-toolkit checkout b40e9c07
  cmake -S . -B build -DENTS_IPC_SOURCE="$PWD/ipc-toolkit"
  cmake --build build --target ents-bench
)help";

} // namespace

std::function<void()> calls(Job& job) {
  return [&job] {
    for (std::int64_t e = 0; e < job.elements().count; e += job.elements_per_call()) job.run();
    asm volatile("" : : "r"(job.results()) : "memory");
  };
}

void print_peer_head(std::ostream& out, const char* peer) {
  out << std::left << std::setw(28) << "" << std::right << std::setw(22) << "ents" << std::setw(12) << peer
      << std::setw(24) << std::string(peer) + " / ents"
      << "\n"
      << std::setw(39) << "single" << std::setw(11) << "of 64" << std::setw(12) << "single" << std::setw(13)
      << "single" << std::setw(11) << "of 64"
      << "\n";
}

void print_peer_row(std::ostream& out, const std::string& name, double single, double of_64, double theirs) {
  out << std::left << std::setw(28) << name << std::right << std::fixed << std::setprecision(0)
      << std::setw(11) << single << std::setw(11) << of_64 << std::setw(12) << theirs << std::setprecision(1)
      << std::setw(13) << theirs / single << std::setw(11) << theirs / of_64 << std::endl;
}

int run_peers(std::ostream& out) {
  const bool calculix = CalculixSpring::available(), ipc = IpcPair::available();
  bool same = true;
  if (calculix) same = print_calculix(out);
  if (calculix && ipc) out << "\n\n";
  if (ipc) same = print_ipc(out) && same;
  if (calculix != ipc) out << "\n";
  if (!calculix) out << how_to_get_calculix;
  if (!calculix && !ipc) out << "\n";
  if (!ipc) out << how_to_get_ipc;
  if (!calculix && !ipc) return 2;
  return same ? 0 : 1;
}

} // namespace bench
