#include "pipelines/studies/study.h"

namespace lamella {

void study_beams(StudyBench& bench);

const std::vector<Study>& studies() {
  static const std::vector<Study> all{
      {"beams", "Do chains of hinges bend as beams do, small and large, and how fast does the error fall?",
       study_beams},
  };
  return all;
}

}  // namespace lamella
