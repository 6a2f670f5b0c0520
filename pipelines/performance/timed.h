// What all programs of this folder measure: processor time, and the memory of the process.
#pragma once
#include <fmt/core.h>
#include <sys/resource.h>
#include <time.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace lamella {

/// Processor time of all threads [s]: what the wall clock shows on one thread of an idle machine.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Largest memory of the process until now [1e6 bytes].
inline double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

/// Mean time of a call [s], over as many calls as take a tenth of a second.
template <class Work>
double seconds_of(Work work) {
  const double start = processor_seconds();
  for (int calls = 1;; ++calls) {
    work();
    const double seconds = processor_seconds() - start;
    if (seconds > 0.1) return seconds / calls;
  }
}

/// A file of numbers and nothing else, as every language reads and writes it.
inline std::vector<double> read_numbers(const std::filesystem::path& path) {
  std::vector<double> numbers(std::filesystem::file_size(path) / sizeof(double));
  std::FILE* file = std::fopen(path.c_str(), "rb");
  const std::size_t read = file ? std::fread(numbers.data(), sizeof(double), numbers.size(), file) : 0;
  if (file) std::fclose(file);
  if (read != numbers.size()) throw std::runtime_error(path.string() + ": cannot be read");
  return numbers;
}

inline void write_numbers(const std::filesystem::path& path, const std::vector<double>& numbers) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const std::size_t written = file ? std::fwrite(numbers.data(), sizeof(double), numbers.size(), file) : 0;
  if (!file || std::fclose(file) != 0 || written != numbers.size())
    throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace lamella
