// SPDX-License-Identifier: MIT
/// \file
/// Tries every fault at an operation in copies of the process, which see a copy of the folder.
///
///   FAULT_EACH    a folder for what the copies write, on the file system of FAULT_BELOW, with two pipes. After each copy a line is
///                 written to "asked": the number of the operation, the fault, the exit code or minus the signal (1000: it did not end),
///                 and a file of /proc with the mounts that the copy saw. Its name is "-" for SIGKILL, which needs no copy. The process
///                 goes on when "answered" has a line.
///   FAULT_LIST    the faults: values of errno, and signals with a minus, such as "28,5,-9"
///   FAULT_TURN    a number: only one fault of the list for each operation, the next one for the next operation; counted from this one
///   FAULT_PART    "2/5": only every fifth operation from the second on
///   FAULT_FROM    only operations from this number on
///
/// A copy has only the thread that was at the operation. So the program must be told to work with one; codecs have one by FAULT_ONE_THREAD,
/// llvmpipe by LP_NUM_THREADS=0. Operations of other threads are only listed, in the file "of_threads". Needs the right to mount.
#pragma once

namespace risorius::fault {

/// Whether faults are tried in copies, and this is not one of them.
bool tries_each();
/// Whether this is a copy.
bool is_copy();
/// Tries all faults. Returns 0 in the process that was called, and after a signal; in a copy with an error, its value.
int try_each(int number);

}  // namespace risorius::fault
