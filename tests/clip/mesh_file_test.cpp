// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"
#include "tests/support/data.h"

namespace limber {
namespace {

TEST(MeshFile, EveryFormatReadsBackWhatItWrote) {
  const test::ScratchFolder folder;
  const Mesh mesh = test::awkward_mesh();
  const std::vector<Vec3f> positions = test::awkward_positions(mesh.vertex_count, 3);
  const std::vector<Vec3f> normals(mesh.vertex_count, Vec3f{0.6f, 0, 0.8f});
  for (const std::string name : {"a.obj", "a.ply", "a.off", "A.OBJ", "A.Ply"}) {
    for (const bool text : {false, true}) {
      for (const bool with_normals : {false, true}) {
        MeshParts parts{mesh.triangles, positions, {}};
        if (with_normals) parts.normals = normals;
        ASSERT_DONE(write_mesh(folder / name, parts, {.replace = true, .text = text}));
        const Result<MeshFile> file = read_mesh(folder / name);
        ASSERT_DONE(file);
        EXPECT_EQ(file->mesh, mesh) << name;
        EXPECT_EQ(file->positions, positions) << name;
      }
    }
  }
}

TEST(MeshFile, RefusesEmptyFilesAndFilesWithoutFaces) {
  EXPECT_ERROR(test::parse("", "a.obj"), kTruncated, "a.obj: the file is empty");
  EXPECT_ERROR(test::parse("", "a.ply"), kTruncated, "a.ply: the file is empty");
  EXPECT_ERROR(test::parse("# nothing\n", "a.obj"), kBadInput, "a.obj: has no faces");
  EXPECT_ERROR(test::parse("v 0 0 0\nv 1 0 0\n", "a.obj"), kBadInput, "a.obj: has no faces");
  EXPECT_ERROR(test::parse("OFF\n1 0 0\n0 0 0\n", "a.off"), kBadInput, "a.off: has no faces");
}

TEST(MeshFile, RefusesMissingFilesAndUnknownExtensions) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(read_mesh(folder / "none.obj"), kNotFound, "none.obj: no such file");
  EXPECT_ERROR(read_mesh(folder / "none.xyz"), kNotFound, "none.xyz: no such file");
  EXPECT_ERROR(read_mesh(folder.write("a.stl", "solid")), kUnsupported, "the extensions are .obj .ply .off");
  EXPECT_ERROR(write_mesh(folder / "b.stl", {}), kUnsupported, "the extensions are .obj .ply .off");
  EXPECT_ERROR(write_mesh(folder.write("c.obj", ""), {}), kExists, "c.obj: is already there");
}

TEST(MeshFile, ReadsEveryMeshOfTheStaticSet) {
  LIMBER_DATA_SET(folder, "static");
  const std::vector<std::pair<std::string, std::pair<Index, std::size_t>>> expected{
      {"stanford-bunny.obj", {35947, 69451}},
      {"cow.obj", {2903, 5804}},
      {"teapot.obj", {3644, 6320}},
      {"truck-nonmanifold.obj", {2956, 4770}},
      {"camel-ref-sumner.obj", {21887, 43814}},
      {"fandisk.obj", {6475, 12946}},
      {"nefertiti-70k.obj", {35002, 70000}},
      {"mountain.obj", {25600, 50562}},
      {"lucy100k.ply", {50002, 100000}},
      {"polygon_mesh.off", {16344, 32245}}};
  for (const auto& [name, counts] : expected) {
    const Result<MeshFile> file = read_mesh(folder / name);
    ASSERT_DONE(file);
    EXPECT_EQ(file->mesh.vertex_count, counts.first) << name;
    EXPECT_EQ(file->mesh.triangles.size(), counts.second) << name;
  }
  std::size_t read_count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!mesh_format(entry.path())) continue;
    const Result<MeshFile> file = read_mesh(entry.path());
    ASSERT_DONE(file);
    EXPECT_GT(file->mesh.triangles.size(), 0u);
    ++read_count;
  }
  EXPECT_GE(read_count, 15u);
}

}  // namespace
}  // namespace limber
