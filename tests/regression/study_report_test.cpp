// Reports of studies: what is near enough, what is a miss, and how both are shown.
#include "pipelines/studies/report.h"

#include <gmock/gmock.h>

#include <cmath>

#include "pipelines/studies/study.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::HasSubstr;

TEST(StudyReport, numbers_off_by_more_than_is_allowed_are_missed) {
  StudyReport report("unused");
  report.compare("near", 1.009, 1, 0.01);
  report.compare("far", 1.011, 1, 0.01);
  report.compare("far below", -1.011, -1, 0.01);
  report.compare_absolute("near", 1e-7, 0, 1e-6);
  report.compare_absolute("far", 1e-5, 0, 1e-6);
  report.at_most("above", 2, 1);
  report.at_least("below", 1, 2);
  report.between("inside", 1, 0, 2);
  report.holds("no", false, "seen");
  EXPECT_EQ(report.checked(), 9);
  EXPECT_EQ(report.missed(), 6);
}

TEST(StudyReport, a_number_that_is_none_is_missed) {
  StudyReport report("unused");
  const double none = std::nan("");
  report.compare("c", none, 1, 0.1);
  report.compare_absolute("a", none, 1, 0.1);
  report.at_most("m", none, 1);
  report.at_least("l", none, 1);
  report.between("b", none, 0, 1);
  EXPECT_EQ(report.missed(), 5);
  EXPECT_THAT(report.markdown("", 2), HasSubstr("| m | nan | at most 1 |"));
}

TEST(StudyReport, findings_in_a_row_form_one_table) {
  StudyReport report("unused");
  report.section("First");
  report.compare("a|b", 2, 2, 0.1);
  report.at_most("bound", 1, 2);
  report.text("A sentence.");
  EXPECT_EQ(report.markdown("", 3),
            "### First\n\n| what | found | expected | error | allowed |  |\n|---|---|---|---|---|---|\n"
            "| a\\|b | 2 | 2 | 0 | 0.1 | met |\n| bound | 1 | at most 2 |  |  | met |\n\nA sentence.\n");
}

TEST(StudyReport, a_chart_is_drawn_into_the_folder_and_linked) {
  TemporaryFolder folder;
  StudyReport report(folder.path());
  Chart chart{.title = "t", .x_label = "x", .y_label = "y"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  chart.curves.push_back(dotted_curve(0, "dots", {1, 10, 100}, {1, 1e-2, 1e-4}));
  chart.curves.push_back(line_curve(1, "line, with a point that has no logarithm", {1, 10, 100}, {1, 0, 1e-4}));
  report.chart("errors", "A caption.", chart);
  EXPECT_GT(std::filesystem::file_size(folder / "errors.png"), 1000u);
  EXPECT_THAT(report.markdown("pictures/", 2), HasSubstr("![errors](pictures/errors.png)"));
}

TEST(StudyReport, twelve_curves_and_what_they_are_compared_with_have_colours_of_their_own) {
  const auto differ = [](const Colour& a, const Colour& b) {
    return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
  };
  for (int k = 0; k < 12; ++k) {
    EXPECT_GT(differ(curve_colour(k), kReferenceColour), 0.3) << k;
    for (int j = 0; j < k; ++j) EXPECT_GT(differ(curve_colour(k), curve_colour(j)), 0.2) << j << " " << k;
  }
}

TEST(ObservedOrder, of_a_power_law_is_its_exponent) {
  const Order order = observed_order({10, 20, 40}, {3e-2, 7.5e-3, 1.875e-3});
  EXPECT_NEAR(order.order, 2, 1e-12);
  EXPECT_NEAR(order.half_width, 0, 1e-6);
  EXPECT_GT(observed_order({10, 20, 40}, {3e-2, 9e-3, 1.875e-3}).half_width, 0.1);
}

TEST(Studies, each_has_its_folder_with_a_page) {
  for (const Study& study : studies()) {
    const std::filesystem::path folder = LAMELLA_SOURCE_DIR "/pipelines/" + study.name;
    EXPECT_TRUE(std::filesystem::exists(folder / "README.md")) << folder;
    EXPECT_TRUE(std::filesystem::exists(folder / (study.name + ".cpp"))) << folder;
    EXPECT_EQ(find_study(folder), &study);
  }
  EXPECT_EQ(find_study(LAMELLA_SOURCE_DIR "/pipelines/program"), nullptr);
}

}  // namespace
}  // namespace lamella
