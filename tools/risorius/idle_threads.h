// SPDX-License-Identifier: MIT
/// \file
/// Threads of libraries that run only when the machine has nothing else to do, such as the one that writes Mesa's cache of shaders.
#pragma once

namespace risorius::cli {

/// Ends the threads of this process that have a lower priority than the one that calls, and waits for them, at most 0.2 s. To
/// be called right before the process ends, and by nobody who goes on: what they held stays held.
///
/// The system keeps a process until its last thread has got a turn, and that thread gives back the memory of them all. On a busy
/// machine a thread of the lowest priority waited 4 to 6 s for it.
void end_idle_threads();

}  // namespace risorius::cli
