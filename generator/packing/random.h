// Random numbers that are the same with every compiler: std::mt19937_64 is specified to the bit, the std distributions are not.
#pragma once
#include <cstdint>
#include <random>

namespace lamella {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In (0, 1): 53 bits, centred in their class so that neither end occurs.
  double unit() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  /// In 0 .. count - 1; the bias is below count / 2^53.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lamella
