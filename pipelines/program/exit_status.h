// What can go wrong, as the exit status of a process: 0 done, 2 the user's input is wrong, 3 the numerics gave up, 4 a file
// cannot be read or written, 130 interrupted.
#pragma once
#include <functional>
#include <string>

namespace lamella {

/// Runs the command; what it throws becomes a message on stderr, every line behind `who`, and an exit status.
int exit_status_of(const std::string& who, const std::function<void()>& command);

}  // namespace lamella
