// What a tissue is like: sizes, shapes, neighbours, and the relations between them.
#pragma once
#include <map>
#include <vector>

#include "generator/statistics/cell_measures.h"
#include "generator/statistics/least_squares.h"

namespace lamella {

/// Bars of equal width.
struct Histogram {
  double low = 0, width = 0;
  std::vector<double> density;  // of probability: sum of density * width is the share of values within
};

/// Bars from `low` to `high`.
Histogram histogram(const std::vector<double>& values, double low, double high, int bars);

/// Cells with n neighbours.
struct ByNeighbours {
  Index count = 0;
  double share = 0;       // p_n
  double area = 0;        // <A|n> / <A>
  double area_error = 0;  // standard error of that mean
  Index surrounded = 0;   // those whose neighbours all count
  double neighbours = 0;  // m(n): mean n of the neighbours of those
  double neighbours_error = 0;
};

/// Cells whose tile the boundary cuts, or that border on such, have neither their area nor their neighbours from the
/// tissue alone. `layers` of them are left out of all that follows but `all_areas`: 1 leaves out cells with a free edge.
struct MosaicStatistics {
  Index cells = 0;                                                    // of the mosaic
  Index counted = 0;                                                  // not left out
  Moments all_areas;                                                  // of all cells [m2]
  Moments areas, perimeters, circularities, elongations, neighbours;  // of the counted: [m2], [m], [1]
  Moments walls;                                                      // lengths, of walls between two counted cells [m]
  Histogram area_histogram;                                           // of A / <A>, all cells
  std::map<Index, ByNeighbours> by_neighbours;
  double mu2 = 0;          // variance of n
  Line lewis;              // A / <A> over n - 6: Lewis' law is 1 + slope (n - 6)
  Line aboav;              // sum of the neighbours' n over n: Aboav and Weaire's law n m(n) = (6 - a) n + 6 a + mu2
  double aboav_a = 0;      // a = 6 - slope
  double weaire_sum = 0;   // <n m(n)> of surrounded cells; <n^2> of all where there is no boundary, exactly
  double square_mean = 0;  // <n^2> of the counted
};

/// Fits weigh every cell the same. Aboav and Weaire's relation uses cells whose neighbours are all counted.
MosaicStatistics statistics(const MosaicMeasures& measures, Index layers = 1);

}  // namespace lamella
