// Rings with cores between plates: what is exact, and which K makes eta.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

namespace lamella {

/// The exact ring: extensible elastica with pressure, R = EI = s = 1 (from its boundary-value problem, to 1e-6). Lengths over b0.
struct ExactRing {
  double strain, force, edge, pressure, contact, width, shrinkage, energies;
};
struct RingTable {
  double eta, axial;
  std::vector<ExactRing> rows;
};
inline const RingTable kExactRings[] = {{0,
                                         4800,
                                         {{.1, 1.173541, 1.173541, 0, 0, 1.083258, .012495, 7.98e-4},
                                          {.2, 2.114380, 2.114380, 0, 0, 1.151526, .046038, 6.04e-4},
                                          {.3, 2.928696, 2.928696, 0, .0386, 1.207366, .096138, 4.76e-4},
                                          {.4, 3.985800, 3.985800, 0, .2574, 1.259285, .164509, 4.41e-4},
                                          {.5, 5.738405, 5.738405, 0, .4761, 1.311203, .253131, 4.82e-4}}},
                                        {1,
                                         4800,
                                         {{.1, 6.44464, 6.44464, 14.7835, 0, 1.07441, 6.160e-3, .690},
                                          {.2, 41.3276, 17.3655, 59.2173, .20232, 1.13516, 2.467e-2, 2.21},
                                          {.3, 149.808, 29.2096, 145.464, .41453, 1.20762, 6.061e-2, 5.26},
                                          {.4, 390.931, 44.2745, 282.817, .61286, 1.28597, 1.178e-1, 8.91},
                                          {.5, 836.199, 63.6651, 480.472, .80393, 1.36574, 2.002e-1, 11.6}}},
                                        {100,
                                         4800,
                                         {{.1, 12.1854, 11.8873, 31.2497, .00477, 1.07418, 1.302e-4, 2.51},
                                          {.2, 107.367, 27.6522, 148.735, .26798, 1.15548, 6.197e-4, 12.1},
                                          {.3, 497.204, 51.3384, 433.100, .51474, 1.27148, 1.805e-3, 39.5},
                                          {.4, 1734.27, 88.5269, 1039.24, .79181, 1.43288, 4.330e-3, 95.7},
                                          {.5, 5379.73, 151.467, 2309.64, 1.13183, 1.66355, 9.624e-3, 193}}},
                                        {1e5,
                                         4800,
                                         {{.1, 12.3142, 11.9562, 31.6152, .00566, 1.07421, 1.317e-7, 2.55},
                                          {.2, 109.186, 27.8712, 151.051, .26916, 1.15605, 6.294e-7, 12.4},
                                          {.3, 509.062, 51.8894, 441.927, .51725, 1.27348, 1.841e-6, 40.9},
                                          {.4, 1794.37, 89.8884, 1068.07, .79793, 1.43853, 4.450e-6, 100},
                                          {.5, 5666.99, 155.059, 2401.93, 1.14740, 1.67863, 1.001e-5, 206}}}};

/// Stiffness of the shell of a polygon against pressure, of which eta is a multiple.
inline double polygon_shell(double axial, int nodes) { return axial / (2 * std::cos(std::numbers::pi / nodes)); }

}  // namespace lamella
