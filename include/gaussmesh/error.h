// The errors that gaussmesh throws, one class for each party that can mend them.
//
// Messages read `where: what was expected, got 'what'`, with a remedy where there is one, and name options as the
// command line of the program does. Only the app turns them into exit codes.
#pragma once

#include <stdexcept>

namespace gaussmesh {

/// Mended in the input file: it cannot be read, or a line of it is not what its format says.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Mended on the command line, or by the caller: an option is out of its range.
struct OptionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No mesh can be made of this molecule at these options: nothing to mesh, or a level too near a critical value.
struct CannotMeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Mended by us: a stage could not keep its promise.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace gaussmesh
