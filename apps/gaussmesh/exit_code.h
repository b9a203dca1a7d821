// What the program ends with.
#pragma once

namespace gaussmesh::app {

/// By who can mend the error; the help and the README list them.
enum ExitCode { kGood = 0, kInternal = 1, kWrongUse = 2, kInput = 3, kCannotMesh = 4, kCheckFailed = 5 };

}  // namespace gaussmesh::app
