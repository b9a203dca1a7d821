// How many threads there may be: OpenMP ends the program where it cannot start one.
#pragma once

#include <CLI/CLI.hpp>

namespace gaussmesh::app {

/// Adds --threads, which fills `threads`; that must outlive the command. @return the option
CLI::Option* add_threads_option(CLI::App& command, int& threads);

/// What a message of fewer threads goes with.
enum class FewerThreads { kWarn, kSayNothing };

/// Finds out whether as many threads can be started, by starting them, and one more for the bar; has OpenMP take as
/// many as could be, at least one, for all that follows. Other programs of the user may still take their place.
///
/// To be called before OpenMP has threads.
/// @param wish  0: one for each processor
/// @return      `wish`, or less where fewer could be started: what to hand on as the number of threads
int take_threads(int wish, FewerThreads message = FewerThreads::kWarn);

}  // namespace gaussmesh::app
