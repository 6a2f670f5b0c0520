// The flags that we build with must not change what a program means. g++ 12.2 with AVX-512 did.
#include <gtest/gtest.h>

#include <vector>

namespace lamella {
namespace {

[[gnu::noinline]] std::vector<double> two_ones_and_two_zeros() { return {1, 1, 0, 0}; }

TEST(Compiler, a_list_of_numbers_keeps_its_values) {
  EXPECT_EQ(two_ones_and_two_zeros(), (std::vector<double>{1.0, 1.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace lamella
