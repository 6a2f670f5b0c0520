// Runs the built program in a shell, as a user does.
#pragma once
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace lamella {

struct Outcome {
  int status = 0;
  std::string said;  // on stdout and stderr
};

inline Outcome shell(const std::string& command) {
  FILE* pipe = ::popen(("{ " + command + "; } 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot start a shell");
  Outcome outcome;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    outcome.said.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

inline const std::string kProgram = LAMELLA_BINARY_DIR "/lamella";

inline Outcome lamella_program(const std::string& arguments) { return shell(kProgram + " " + arguments); }

inline std::string write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Nine hexagons, pulled until they part: a run of about a second.
inline const std::string kHoneycomb = R"(title = "Nine hexagons"
[sample]
kind = "honeycomb"
columns = 3
rows = 3
side = "20 um"
walls.segments = 2
[cells]
thickness = "1 um"
young = "100 MPa"
density = 1000
[links]
normal_stiffness = "1e12 N/m2"
tangential_stiffness = "1e11 N/m2"
normal_strength = "20 N/m"
tangential_strength = "20 N/m"
[loading]
strain_rate = 2000
strain = 0.02
[output]
frames = 5
response = 50
)";

}  // namespace lamella
