#pragma once

namespace rsphere {

// Limits the memory of this process to the memory of the machine including swap, unless the process already
// has a limit (ulimit -v, -d). An allocation beyond the limit fails, which results in a message and exit
// status 2. Without a limit, Linux would grant more memory than exists, and later kill a process without a
// message.
void limitMemory();

}  // namespace rsphere
