#include "process/memory_limit.h"

#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace rsphere {

void limitMemory() {
  rlimit data{}, space{};
  if (getrlimit(RLIMIT_DATA, &data) != 0 || getrlimit(RLIMIT_AS, &space) != 0) return;
  if (data.rlim_cur != RLIM_INFINITY || space.rlim_cur != RLIM_INFINITY) return;
  struct sysinfo machine {};
  if (sysinfo(&machine) != 0) return;
  // The memory already in use is added. It is small, except with a sanitizer, which reserves terabytes.
  uint64_t used[6] = {};
  std::ifstream pages("/proc/self/statm");
  for (uint64_t& n : used) pages >> n;
  if (!pages) return;
  const auto page = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  data.rlim_cur = used[5] * page + (machine.totalram + machine.totalswap) * machine.mem_unit;
  setrlimit(RLIMIT_DATA, &data);
}

}  // namespace rsphere
