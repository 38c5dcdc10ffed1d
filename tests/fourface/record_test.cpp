// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limber {
namespace {

using testing::ElementsAre;

// Two triangles, whose edge is swapped, and back.
class RecordOfSwaps : public testing::Test {
 protected:
  RecordOfSwaps() {
    for (const float error : {2.0f, 1.0f}) {
      Star star;
      // 0 has neighbours on a border; its inner edge is the one between both faces.
      const Index v = faces_.has_edge(0, 2) ? 0 : 1;
      faces_.gather(v, star);
      const std::array<Index, 2> before{triangle(star.spoke[0]), triangle(star.spoke[1])};
      record_.add(faces_, v, static_cast<double>(error), before, faces_.swap(star, 1), 1);
    }
  }
  Index triangle(Index half_edge) const { return faces_.face(FaceTable::face_of(half_edge)).triangle; }

  Mesh mesh_{4, {{0, 1, 2}, {0, 2, 3}}};
  FaceTable faces_{mesh_};
  Record record_{mesh_, faces_};
};

TEST_F(RecordOfSwaps, NumbersTrianglesInTheOrderInWhichTheyAreCreated) {
  EXPECT_TRUE(record_.end_level());
  EXPECT_FALSE(record_.end_level());
  const FourKMesh made = std::move(record_).take();
  EXPECT_THAT(made.creator, ElementsAre(kNone, kNone, 0, 0, 1, 1));
  EXPECT_THAT(made.destroyer, ElementsAre(0, 0, 1, 1, kNone, kNone));
  EXPECT_THAT(made.level_begin, ElementsAre(0, 2));
}

TEST_F(RecordOfSwaps, BeginsATriangleWithTheCornerAskedFor) {
  const Index first = faces_.face(0).triangle == 4 ? 0 : 1;
  const Index last_corner = faces_.face(first).corners[2];
  record_.begin_with(last_corner);
  EXPECT_EQ(std::move(record_).take().triangles[4][0], last_corner);
}

TEST_F(RecordOfSwaps, GetsErrorsAndSpheresThatCoverWhatComesBefore) {
  FourKMesh made = std::move(record_).take();
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  make_monotone(made, positions, 4);
  EXPECT_THAT(made.error, ElementsAre(0.5f, 0.5f));
  // From 0 to the corner across, and from there on to 1, which is one away.
  EXPECT_NEAR(made.radius[0], 1.4142, 1e-3);
  EXPECT_NEAR(made.radius[1], 2.4142, 1e-3);
}

}  // namespace
}  // namespace limber
