#pragma once

namespace rsphere {

// Limits the memory of this process to that of the machine, swap included, unless the process already has a
// limit (ulimit -v, -d). An allocation beyond the limit fails, which becomes a message and exit status 2.
// Without the limit, Linux would grant memory that does not exist and later kill a process without a message.
void limitMemory();

}  // namespace rsphere
