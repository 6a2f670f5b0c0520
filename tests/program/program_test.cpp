// The program does what its help says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "generator/sample/sample_file.h"
#include "generator/sample/scene.h"
#include "tests/program/program.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class program : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string scene = write_file(folder / "scene.toml", kHoneycomb);
  std::string at(const std::string& name) const { return (folder / name).string(); }
};

TEST_F(program, help_shows_an_example_for_each_subcommand) {
  EXPECT_THAT(lamella_program("--help").said, HasSubstr("lamella run scene.toml -o results"));
  for (const std::string name : {"run", "generate", "simulate", "extract", "export", "post", "describe", "check"}) {
    const Outcome help = lamella_program(name + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.said, HasSubstr("Example:\n  lamella " + name));
  }
}

TEST_F(program, describe_prints_the_rows) {
  EXPECT_EQ(lamella_program("describe").said, describe_scene());
  EXPECT_EQ(lamella_program("describe --markdown").said, scene_reference());
}

TEST_F(program, check_writes_nothing_and_says_what_would_be_modelled) {
  const Outcome check = lamella_program("check " + scene);
  EXPECT_EQ(check.status, 0) << check.said;
  EXPECT_THAT(check.said, AllOf(HasSubstr("scene.toml: fine"), HasSubstr("9 cells")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
            1);
}

TEST_F(program, run_is_generate_simulate_and_post) {
  const Outcome run = lamella_program("run " + scene + " -o " + at("all"));
  ASSERT_EQ(run.status, 0) << run.said;
  for (const char* name : {"sample.h5", "trajectory.h5", "cells.pvd", "summary.json", "response.csv", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder / "all" / name)) << name;
  EXPECT_THAT(run.said, Not(HasSubstr("\r"))) << "output to a file has plain lines";

  ASSERT_EQ(lamella_program("generate " + scene + " -q -o " + at("sample.h5")).said, "");
  ASSERT_EQ(
      lamella_program("simulate " + scene + " -q --sample " + at("sample.h5") + " -o " + at("trajectory.h5")).said, "");
  ASSERT_EQ(lamella_program("post " + at("trajectory.h5") + " -q -o " + at("parts")).said, "");
  EXPECT_EQ(read_file(folder / "parts" / "response.csv"), read_file(folder / "all" / "response.csv"));
}

TEST_F(program, generate_makes_the_same_cells_on_any_number_of_threads) {
  const std::string tissue =
      write_file(folder / "tissue.toml",
                 "[sample]\nkind = \"tissue\"\npacking = { count = 3000, fraction = 0.7 }\nwalls = { segments = 4 }\n"
                 "sizes = { distribution = \"lognormal\", mean = 1, cv = 0.3 }\n[cells]\nthickness = 0.05\n");
  for (const std::string threads : {"1", "2", "3"})
    ASSERT_EQ(lamella_program("generate " + tissue + " -q --threads " + threads + " -o " + at(threads + ".h5") +
                              " --export " + at(threads + ".off"))
                  .said,
              "");
  EXPECT_EQ(read_file(folder / "1.off"), read_file(folder / "2.off"));
  EXPECT_EQ(read_file(folder / "1.off"), read_file(folder / "3.off"));
  const Sample one = read_sample(folder / "1.h5"), three = read_sample(folder / "3.h5");
  EXPECT_EQ(one.x, three.x);
  EXPECT_EQ(one.rest_angle, three.rest_angle);
}

TEST_F(program, extract_makes_a_frame_the_sample_of_other_scenes) {
  ASSERT_EQ(lamella_program("run " + scene + " -q --set output.frames=4 -o " + at("all")).status, 0);
  const Outcome extract =
      lamella_program("extract " + at("all/trajectory.h5") + " -o " + at("loaded.h5") + " --frame 2");
  ASSERT_EQ(extract.status, 0) << extract.said;
  EXPECT_THAT(extract.said, AllOf(HasSubstr("frame 2 of 6"), HasSubstr("9 cells")));
  const Outcome next =
      lamella_program("simulate " + scene + " -q --sample " + at("loaded.h5") + " -o " + at("next.h5"));
  EXPECT_EQ(next.status, 0) << next.said;
  EXPECT_EQ(lamella_program("extract " + at("all/trajectory.h5") + " -q -o " + at("last.h5")).said, "");
}

TEST_F(program, settings_and_seed_reach_the_sample) {
  ASSERT_EQ(lamella_program("generate " + scene + " -q -o " + at("a.h5") + " --set sample.columns=5 --seed 42").status,
            0);
  const Outcome check = lamella_program("generate " + scene + " -o " + at("b.h5") + " --set sample.columns=5");
  EXPECT_THAT(check.said, HasSubstr("15 cells"));
}

TEST_F(program, an_interrupted_run_resumes_to_the_same_result) {
  // The signal follows the first frame on disk, whatever the machine is busy with. Should the run have ended in the meantime,
  // it is asked for more rows, and so for more steps.
  Outcome cut;
  std::string command, folder_of_cut;
  for (int response = 2000; response <= 32000; response *= 4) {
    command = "run " + scene + " -q --set output.frames=40 --set loading.strain_rate=200 --set output.response=" +
              std::to_string(response) + " -o ";
    folder_of_cut = at("cut_" + std::to_string(response));
    cut = shell(kProgram + " " + command + folder_of_cut + " & run=$!; while kill -0 $run && ! [ -e " + folder_of_cut +
                "/trajectory.h5.parts/frame_000001.h5 ]; do sleep 0.005; done; kill -INT $run; wait $run");
    if (cut.status == 130) break;
  }
  ASSERT_EQ(cut.status, 130) << cut.said;
  EXPECT_THAT(cut.said, HasSubstr("interrupted; what was computed is in " + folder_of_cut));
  EXPECT_FALSE(std::filesystem::exists(folder_of_cut + "/summary.json"));
  const Outcome resumed = lamella_program(command + folder_of_cut + " --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.said;
  ASSERT_EQ(lamella_program(command + at("whole")).status, 0);
  EXPECT_EQ(read_file(folder_of_cut + "/response.csv"), read_file(folder / "whole" / "response.csv"));
}

TEST_F(program, a_killed_run_resumes_to_the_same_result) {
  const std::string command = "run " + scene + " -q --set output.frames=40 --set loading.strain_rate=200 -o ";
  const std::string killed = at("killed");
  shell(kProgram + " " + command + killed + " & run=$!; while kill -0 $run && ! [ -e " + killed +
        "/trajectory.h5.parts/frame_000001.h5 ]; do sleep 0.005; done; kill -KILL $run; wait $run");
  const Outcome resumed = lamella_program(command + killed + " --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.said;
  ASSERT_EQ(lamella_program(command + at("whole")).status, 0);
  EXPECT_EQ(read_file(killed + "/response.csv"), read_file(folder / "whole" / "response.csv"));
}

TEST_F(program, resuming_with_another_scene_is_refused) {
  ASSERT_EQ(lamella_program("run " + scene + " -q -o " + at("out")).status, 0);
  const Outcome outcome = lamella_program("run " + scene + " -q --resume --set loading.strain=0.03 -o " + at("out"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.said, HasSubstr("another scene"));
}

TEST_F(program, a_run_to_an_accuracy_says_how_far_off_it_is) {
  const std::string elastic = " --set links.normal_strength=1e9 --set links.tangential_strength=1e9";
  const Outcome run = lamella_program("run " + scene + elastic + " --accuracy 5% -o " + at("five"));
  ASSERT_EQ(run.status, 0) << run.said;
  const auto number = [&](const char* key) {
    const auto summary = nlohmann::json::parse(read_file(folder / "five" / "summary.json"));
    return summary.at("accuracy").at(key).at("value").get<double>();
  };
  EXPECT_EQ(number("accepted_error"), 0.05);
  const double estimated = number("estimated_error_of_largest_load");
  EXPECT_LE(estimated, 0.05);
  const auto table = nlohmann::json::parse(read_file(folder / "five" / "accuracy.json"));
  ASSERT_GE(table.at("runs").size(), 2u);
  // The settings that it says it used make the same run, and one eight times slower is nearer the truth.
  std::string settings = elastic;
  for (const auto& setting : table["runs"].back()["settings"]) settings += " --set " + setting.get<std::string>();
  ASSERT_EQ(lamella_program("run " + scene + settings + " -q -o " + at("same")).status, 0);
  EXPECT_EQ(read_file(folder / "same" / "response.csv"), read_file(folder / "five" / "response.csv"));
}

TEST_F(program, an_accuracy_that_cannot_be_had_is_an_error) {
  const Outcome run = lamella_program("run " + scene + " --accuracy 1e-9 -o " + at("out"));
  EXPECT_EQ(run.status, 3) << run.said;
  EXPECT_THAT(run.said, HasSubstr("is not reached"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "trajectory.h5"));
  for (const char* wrong : {"0", "-1%", "2", "much"})
    EXPECT_EQ(lamella_program("run " + scene + " --accuracy " + wrong + " -o " + at("not")).status, 2) << wrong;
  EXPECT_FALSE(std::filesystem::exists(folder / "not"));
  EXPECT_EQ(lamella_program("simulate " + scene + " --set run.accuracy=0.1 --sample x.h5 -o " + at("t.h5")).status, 2);
}

TEST_F(program, an_ensemble_gives_mean_and_deviation_of_every_number) {
  const Outcome outcome = lamella_program("run " + scene + " -o " + at("many") + " --seeds 4-6 --jobs 2");
  ASSERT_EQ(outcome.status, 0) << outcome.said;
  EXPECT_THAT(outcome.said, AllOf(HasSubstr("over 3 runs"), HasSubstr("deviation")));
  const auto read = [&](const std::string& name) { return nlohmann::json::parse(read_file(folder / "many" / name)); };
  const auto ensemble = read("ensemble.json");
  EXPECT_EQ(ensemble["seeds"], (std::vector<int>{4, 5, 6}));
  // The honeycomb has nothing random: what is not a duration is the same in every run.
  int compared = 0;
  const auto single = read("seed_5/summary.json");
  for (const auto& [name, quantity] : ensemble["quantities"].items()) {
    const auto dot = name.find('.');
    if (name.substr(0, dot) == "run") continue;
    EXPECT_EQ(quantity["runs"], 3) << name;
    EXPECT_NEAR(quantity["mean"].get<double>(),
                single[name.substr(0, dot)][name.substr(dot + 1)]["value"].get<double>(),
                1e-12 * std::abs(quantity["mean"].get<double>()))
        << name;
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST_F(program, a_failed_seed_shows_in_the_exit_status) {
  const Outcome outcome =
      lamella_program("run " + scene + " -q -o " + at("many") + " --seeds 1-2 --set run.time_step=1");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.said, AllOf(HasSubstr("seed 1: "), HasSubstr("seed 2: ")));
}

}  // namespace
}  // namespace lamella
