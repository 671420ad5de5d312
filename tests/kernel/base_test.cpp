// Numbers, names and files: the small things every message and output stands on.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/base/progress.hpp"
#include "kernel/base/text_file.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

TEST(PlaceText, RoundsToTheResolutionWithoutExponent) {
  EXPECT_EQ(place_text(1000.12345, 0.02), "1000.12");
  EXPECT_EQ(place_text(1e6, 0.001), "1000000");
  EXPECT_EQ(place_text(0.5, 0.001), "0.5");
  EXPECT_EQ(place_text(-1e-9, 0.001), "0");
  EXPECT_EQ(place_text(1234.5, 10.0), "1234");
  EXPECT_EQ(place_text(0.1, 0.0), "0.1");
  EXPECT_EQ(place_text(1e300, 1.0), "1e+300");
  EXPECT_EQ(place_text(std::nan(""), 1.0), "nan");
}

TEST(NumberText, ReadsBackToTheSameDouble) {
  test::for_all([](test::Rng& rng) {
    const double x = std::ldexp(test::uniform(rng, -1.0, 1.0), test::integer(rng, -300, 300));
    EXPECT_EQ(std::stod(number_text(x)), x);
  });
}

TEST(NearestWord, FindsTyposAndOnlyThose) {
  const std::vector<std::string> words{"radius", "width", "continuity", "trimline"};
  const auto nearest = [&](const char* typed) { return nearest_word(typed, words.data(), words.size()); };
  EXPECT_EQ(nearest("contnuity"), "continuity");
  EXPECT_EQ(nearest("widht"), "width");
  EXPECT_EQ(nearest("Radius"), "radius");
  EXPECT_EQ(nearest("colour"), std::nullopt);
  EXPECT_EQ(nearest(std::string(100000, 'x').c_str()), std::nullopt);
}

TEST(InputErrorText, ListsEveryProblemUnderItsPointer) {
  const InputError e(std::vector<Problem>{{"radius", "is -1, must be > 0"}, {"", "is empty"}});
  EXPECT_EQ(e.under("/primaries/main").problems(),
            (std::vector<Problem>{{"/primaries/main/radius", "is -1, must be > 0"},
                                  {"/primaries/main", "is empty"}}));
}

TEST(TextFile, IsWholeOrNotThere) {
  const fs::path folder = fs::temp_directory_path() / "blendwright-base-test";
  fs::create_directories(folder);
  write_text_file(folder / "a.txt", "first");
  write_text_file(folder / "a.txt", "second");
  EXPECT_EQ(read_text_file(folder / "a.txt", 100), "second");
  EXPECT_THROW((void)read_text_file(folder / "a.txt", 3), IoError);
  EXPECT_THROW(write_text_file(folder / "missing" / "a.txt", "x"), IoError);
  EXPECT_THROW(write_text_file(folder, "x"), IoError);
  EXPECT_THROW(write_text_file("/dev/null", "x"), IoError);
  {
    const UnfinishedFile abandoned(folder / "b.txt");
    std::ofstream(abandoned.path()) << "half";
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  fs::remove_all(folder);
}

TEST(ParallelFor, CoversEveryIndexOnceAndRethrows) {
  for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
    std::vector<std::atomic<int>> seen(count);
    parallel_for(count, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const auto& n : seen) EXPECT_EQ(n, 1);
  }
  EXPECT_THROW(parallel_for(100, 1,
                            [](std::size_t i, std::size_t) {
                              if (i == 57) throw GeometryError("here");
                            }),
               GeometryError);
}

TEST(Progress, StopsAtTheNextPoll) {
  std::stop_source source;
  const Progress progress{.report = [](double, std::string_view) {}, .stop = source.get_token()};
  EXPECT_NO_THROW(progress.at(0.5, "fitting"));
  source.request_stop();
  EXPECT_THROW(progress.at(0.6, "fitting"), Cancelled);
}

}  // namespace
}  // namespace blendwright
