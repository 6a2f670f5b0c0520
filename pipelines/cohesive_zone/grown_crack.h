// A crack between two beams, grown through links that soften.
#pragma once
#include "pipelines/studies/study.h"

namespace lamella {

struct GrownCrack {
  std::vector<double> time, ratio;           // J / G, at frames
  double mean = 0, lowest = 0, highest = 0;  // where two links or more are gone
  double ledger = 0;
  double seconds = 0;  // of the run
};

/// J s = 2 P theta of two beams that turn by theta each where forces P part them (Paris and Paris), over the toughness.
/// `zone`: over how many spacings links soften; `more`: settings over those of `file`, which is beams.toml.
GrownCrack grow_crack(StudyBench& bench, const std::string& file, double zone,
                      const std::vector<std::string>& more = {});

}  // namespace lamella
