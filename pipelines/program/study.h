// `lamella study`: runs studies and says whether their numbers are as they should be.
#pragma once
#include <filesystem>
#include <vector>

#include "pipelines/program/progress.h"
#include "pipelines/studies/study.h"

namespace lamella {

struct StudyArguments {
  std::vector<std::filesystem::path> folders;  // of studies, such as pipelines/beams
  std::filesystem::path out;
  std::filesystem::path page;  // one Markdown page of all of them, with its pictures beside it; empty: none
  StudySize size = StudySize::kFull;
  int jobs = 1;
};

/// Runs each study in a process of its own, into OUT/NAME/: study.md, findings.csv, pictures and runs. Returns 0, or 1 where a finding
/// misses what is expected, or the status of the first study that could not be run to its end.
int study_command(const StudyArguments& arguments, Verbosity verbosity);

/// `lamella accuracy`: the study of `folder`, with a page of its own. `folders` and `jobs` of the arguments are not used.
int accuracy_command(const std::filesystem::path& folder, const StudyArguments& arguments, Verbosity verbosity);

}  // namespace lamella
