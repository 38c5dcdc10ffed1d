// SPDX-License-Identifier: Apache-2.0
#include "eval/mesh_source.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace limber::eval {
namespace {

class MeshSourceTest : public testing::Test {
 protected:
  MeshSourceTest() : folder_(std::filesystem::path(testing::TempDir()) / "limber-mesh-source") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "3.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(folder_ / "4.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
  }
  ~MeshSourceTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(MeshSourceTest, TheConnectivityOfFilesMayChange) {
  for (const std::string& name : {folder_.string(), (folder_ / "%d.obj").string(), (folder_ / "*.obj").string()}) {
    const auto source = open_meshes(name, {});
    ASSERT_TRUE(source) << source.error().line();
    EXPECT_EQ((*source)->frame_count(), 2u);
    EXPECT_EQ((*source)->first_frame_number(), 3u);
    SourceMesh mesh;
    ASSERT_TRUE(*(*source)->read(mesh));
    EXPECT_EQ(mesh.triangles.size(), 1u);
    ASSERT_TRUE(*(*source)->read(mesh));
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_TRUE(mesh.nodes.empty());
    EXPECT_FALSE(*(*source)->read(mesh));
  }
}

TEST_F(MeshSourceTest, FramesCanBeChosen) {
  ClipOptions options;
  options.first = 4;
  const auto source = open_meshes(folder_.string(), options);
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->first_frame_number(), 4u);
  EXPECT_EQ((*source)->frame_count(), 1u);
}

TEST_F(MeshSourceTest, VerticesOfAClipAreTheSameInEveryFrame) {
  const auto source = open_meshes("sample:flag?vertices=100&frames=2", {});
  ASSERT_TRUE(source);
  SourceMesh mesh;
  ASSERT_TRUE(*(*source)->read(mesh));
  EXPECT_EQ(mesh.nodes.size(), 100u);
  EXPECT_EQ(mesh.nodes[99], 99u);
}

TEST_F(MeshSourceTest, WhatIsNotThereIsNotFound) {
  EXPECT_EQ(open_meshes((folder_ / "5.obj").string(), {}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(open_stream_meshes((folder_ / "a.limber").string(), {}, {}).error().code, ErrorCode::kNotFound);
}

TEST_F(MeshSourceTest, BrokenStreamsAreRefusedWithTheirName) {
  const std::string name = (folder_ / "a.limber").string();
  std::ofstream(name) << "not a stream at all, though it is long enough for a header or so";
  const auto source = open_stream_meshes(name, {}, {});
  ASSERT_FALSE(source);
  EXPECT_NE(source.error().where.find("a.limber"), std::string::npos);
}

}  // namespace
}  // namespace limber::eval
