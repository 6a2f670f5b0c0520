// Ctrl-C and SIGTERM ask for an orderly end: what was computed is brought to disk first. The second one ends at once.
#pragma once
#include <atomic>

namespace lamella {

void listen_for_interrupts();
/// True once the user has asked for the end.
const std::atomic<bool>& interrupted();
/// Throws Interrupted once the user has asked for the end.
void stop_if_interrupted();

}  // namespace lamella
