// SPDX-License-Identifier: MIT
/// \file
/// Signals that ask the program to stop: a terminal that is closed, Ctrl-C, and kill (HUP, INT, TERM).
///
/// A run takes notice between two of its steps and ends by itself. If it has not within a tenth of a second, or after a second signal, a thread
/// removes what the run has begun to write and ends the program. Once the outputs are decided, a signal has no effect any more.
#pragma once

#include <string>

namespace risorius::cli {

/// Notes the signals from now on. It may be called before the libraries of the program are initialised. Signals that the parent
/// ignores, as nohup does, stay ignored.
void note_stops();

/// Call it first of all in main(), after note_stops(). A reader of the output that has gone (PIPE) and the limit of the size of a file
/// (XFSZ) become errors of writing. `json`: what ends the run is said in JSON too.
void catch_stop_signals(bool json);

/// Whether the run should stop.
bool stop_is_asked();

/// What the program says when it was stopped.
std::string stop_message();

/// The run has ended by itself; from now on no signal ends the program.
void end_of_run();

}  // namespace risorius::cli
