#pragma once

namespace rsphere {

// Where the system sets this process no limit of its own (ulimit -v, -d): lets it have as much memory as the
// machine has, swap included. Beyond that allocations fail, which is a message and exit status 2, where Linux
// would give out memory that is not there and then end some process without a word.
void limitMemory();

}  // namespace rsphere
