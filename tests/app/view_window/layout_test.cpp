// Parts of the window lie beside each other at every size and with every set of parts.
#include "app/view/window/layout.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

namespace blendwright {
namespace {

using Named = std::pair<std::string, PixelBox>;

/// Everything that may not overlap; empty boxes are parts that are not there.
std::vector<Named> parts_of(const ViewLayout& l) {
  std::vector<Named> parts{{"heading", l.heading},
                           {"picked", l.picked},
                           {"bar", l.bar},
                           {"status", l.status},
                           {"message", l.message}};
  for (std::size_t i = 0; i < l.labels.size(); ++i) {
    parts.emplace_back("label " + std::to_string(i), l.labels[i]);
    parts.emplace_back("track " + std::to_string(i), l.tracks[i]);
  }
  for (const PixelBox& b : l.titles) parts.emplace_back("title", b);
  for (const PixelBox& b : l.panes) parts.emplace_back("pane", b);
  std::erase_if(parts, [](const Named& p) { return p.second.width() <= 0.0; });
  return parts;
}

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

void expect_in_order(const LayoutRequest& request) {
  const ViewLayout l = layout_of(request);
  const std::vector<Named> parts = parts_of(l);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PixelBox& b = parts[i].second;
    EXPECT_TRUE(b.left >= 0.0 && b.bottom >= 0.0 && b.right <= request.width && b.top <= request.height &&
                b.height() > 0.0)
        << parts[i].first << " at " << request.width << " x " << request.height;
    for (std::size_t j = i + 1; j < parts.size(); ++j)
      EXPECT_FALSE(overlap(b, parts[j].second)) << parts[i].first << " and " << parts[j].first << " at "
                                                << request.width << " x " << request.height;
  }
  EXPECT_FALSE(overlap(l.help, l.status));
}

template <class Use>
void for_each_request(Use use) {
  for (const auto& [width, height] :
       {std::array{640, 480}, std::array{1280, 960}, std::array{480, 360}, std::array{4096, 2160}})
    for (const std::size_t panes : {1u, 2u})
      for (const std::size_t controls : {0u, 1u, 6u, 40u})
        for (const bool bar : {false, true})
          for (const bool picked : {false, true})
            use(LayoutRequest{width, height, panes, controls, 0, bar, picked});
}

TEST(ViewLayout, NothingOverlapsOrLeavesTheWindow) { for_each_request(expect_in_order); }

TEST(ViewLayout, OverlapsAreSeen) {  // negative control of the check above
  EXPECT_TRUE(overlap({0, 0, 10, 10}, {9, 9, 20, 20}));
  EXPECT_FALSE(overlap({0, 0, 10, 10}, {10, 0, 20, 10}));
}

TEST(ViewLayout, TheObjectHasHalfOfTheWindowWithOneFile) {
  for (const auto& [width, height] : {std::array{640, 480}, std::array{1280, 960}}) {
    const ViewLayout l = layout_of({width, height, 1, 6, 0, true, true});
    EXPECT_GE(l.panes[0].width() * l.panes[0].height(), 0.45 * width * height) << width;
  }
}

TEST(ViewLayout, EveryControlIsOnExactlyOnePage) {
  for_each_request([](LayoutRequest request) {
    std::size_t next = 0;
    for (request.page = 0; request.page < layout_of(request).pages; ++request.page) {
      const ViewLayout l = layout_of(request);
      EXPECT_EQ(l.first_control, next);
      next += l.tracks.size();
    }
    EXPECT_EQ(next, request.controls);
  });
}

TEST(ViewLayout, APageBeyondTheLastIsTheLast) {
  LayoutRequest request{640, 480, 1, 40, 1000, false, false};
  const ViewLayout beyond = layout_of(request);
  request.page = beyond.pages - 1;
  EXPECT_EQ(beyond.first_control, layout_of(request).first_control);
}

}  // namespace
}  // namespace blendwright
