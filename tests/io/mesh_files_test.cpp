#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "io/samples.h"
#include "io/temporary_folder.h"
#include "lascaux/io/read_mesh.h"
#include "lascaux/io/write_3mf.h"
#include "lascaux/io/write_glb.h"
#include "lascaux/io/write_obj.h"
#include "lascaux/io/write_ply.h"
#include "lascaux/io/write_stl.h"
#include "lascaux/io/write_usda.h"
#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/vertex_normals.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;

/// A writer of the sample with parts, for each format.
std::map<std::string, std::function<Diagnostics(const std::filesystem::path&)>> Writers() {
  static const Mesh mesh = SampleSphere(3);
  static const MeshDetails details = SampleDetails(mesh);
  const MeshFileOptions options{Unit::kMetre, "a & <b>", {{"creator", "lascaux \"test\""}}};
  return {
      {"stl", [](const auto& path) { return WriteStl(path, mesh); }},
      {"3mf",
       [=](const auto& path) {
         return Write3mf(path, mesh, details, {options, {}});
       }},
      {"glb", [=](const auto& path) { return WriteGlb(path, mesh, details, options); }},
      {"obj", [=](const auto& path) { return WriteObj(path, mesh, details, options); }},
      {"ply", [=](const auto& path) { return WritePly(path, mesh, details, options); }},
      {"usda",
       [=](const auto& path) {
         return WriteUsda(path, mesh, details, {options, "a.vdb"});
       }},
  };
}

/// The bytes of the sample in each format that is read.
std::map<std::string, std::string> Files() {
  const TemporaryFolder folder;
  std::map<std::string, std::string> files;
  for (const auto& [ending, write] : Writers()) {
    if (ending == "usda") continue;
    EXPECT_TRUE(write(folder / ending).empty()) << ending;
    files[ending] = Contents(folder / ending);
  }
  return files;
}

std::string CodeOf(const Outcome<LoadedMesh>& outcome) {
  return outcome ? "" : outcome.diagnostics().front().code;
}

TEST(MeshFiles, WhatIsWrittenIsReadBackWithItsPartsAndStaysPrintable) {
  const Mesh mesh = SampleSphere(3);
  const MeshDetails details = SampleDetails(mesh);
  for (const auto& [ending, bytes] : Files()) {
    SCOPED_TRACE(ending);
    const auto loaded = ReadMesh(bytes);
    ASSERT_TRUE(loaded.ok());
    EXPECT_TRUE(CheckMesh(loaded->mesh).IsPrintable());
    ASSERT_EQ(loaded->mesh.vertices.size(), mesh.vertices.size());
    ASSERT_EQ(loaded->mesh.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(loaded->millimetres, ending == "stl" || ending == "3mf" ? 1 : 1000);
    double volume = CheckMesh(loaded->mesh).volume;
    volume *= std::pow(loaded->millimetres, 3);
    EXPECT_NEAR(volume, CheckMesh(mesh).volume, 1e-4 * volume);
    if (ending == "stl") continue;
    ASSERT_EQ(loaded->details.parts.size(), 2U);
    EXPECT_EQ(loaded->details.parts[1].name, "limb-1");
    std::size_t upper = 0, expected = 0;
    for (const std::uint16_t part : loaded->details.triangle_parts) upper += part;
    for (const std::uint16_t part : details.triangle_parts) expected += part;
    // PLY has parts at vertices alone.
    EXPECT_NEAR(static_cast<double>(upper), static_cast<double>(expected),
                ending == "ply" ? 30 : 0);
  }
}

TEST(MeshFiles, StlAnd3mfKeepTheMeshsOwnFloats) {
  const Mesh mesh = SampleSphere(3);
  const auto threemf = ReadMesh(Files()["3mf"]);
  ASSERT_TRUE(threemf.ok());
  EXPECT_EQ(threemf->mesh, mesh);
}

TEST(MeshFiles, TheSameMeshGivesTheSameBytes) { EXPECT_EQ(Files(), Files()); }

TEST(MeshFiles, AFullDiskIsAnErrorInEveryFormat) {
  for (const auto& [ending, write] : Writers()) {
    const Diagnostics diagnostics = write("/dev/full");
    ASSERT_EQ(diagnostics.size(), 1U) << ending;
    EXPECT_EQ(diagnostics[0].code, "cannot-write") << ending;
  }
}

TEST(MeshFiles, UsdaRefersToTheVolumeAndEscapesNames) {
  const TemporaryFolder folder;
  ASSERT_TRUE(Writers()["usda"](folder / "a").empty());
  const std::string text = Contents(folder / "a");
  EXPECT_NE(text.find("asset filePath = @a.vdb@"), std::string::npos);
  EXPECT_NE(text.find("def Xform \"a____b_\""), std::string::npos);
  EXPECT_NE(text.find("creator = \"lascaux \\\"test\\\"\""), std::string::npos);
}

TEST(MeshFiles, UsdaTurnsAVolumeWithZUpAndKnowsItsFog) {
  const TemporaryFolder folder;
  UsdaOptions options;
  options.volume = "a.vdb";
  options.volume_up = UpAxis::kZ;
  options.fog = true;
  ASSERT_TRUE(WriteUsda(folder / "a", SampleSphere(3), {}, options).empty());
  const std::string text = Contents(folder / "a");
  const std::string volume = text.substr(text.find("def Volume"));
  EXPECT_NE(volume.find("xformOp:rotateX = -90"), std::string::npos);
  EXPECT_NE(volume.find("extent = [(-0.015, -0.017, 0), (0.025, 0.023, 0.04)]"), std::string::npos)
      << volume;
  EXPECT_NE(volume.find("rel field:density = </animal/volume/density>"), std::string::npos);
}

TEST(ReadMesh, ReadsPolygonsNegativeIndicesAndTextFormats) {
  const auto obj = ReadMesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4/1 -3/2/3 3//7 4\n");
  ASSERT_TRUE(obj.ok());
  EXPECT_EQ(obj->mesh.triangles.size(), 2U);
  EXPECT_EQ(obj->mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  const auto stl = ReadMesh(
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e0 0 0\nvertex 0 +1 0\n"
      "endloop\nendfacet\nendsolid\n");
  ASSERT_TRUE(stl.ok());
  EXPECT_EQ(stl->mesh.triangles.size(), 1U);
  EXPECT_EQ(stl->mesh.vertices[2], Eigen::Vector3f(0, 0, -1));  // Z up
  const std::string header =
      "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_index\nend_header\n";
  const auto ply = ReadMesh("ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_TRUE(ply.ok());
  std::string big = "ply\nformat binary_big_endian 1.0\n" + header;
  for (const char* number :
       {"\0\0", "\0\0", "\0\0", "\x3f\xf0", "\0\0", "\0\0", "\0\0", "\x3f\xf0", "\0\0"})
    big += std::string(number, 2) + std::string(6, '\0');
  big += std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2", 13);
  const auto swapped = ReadMesh(big);
  ASSERT_TRUE(swapped.ok());
  EXPECT_EQ(swapped->mesh, ply->mesh);
}

TEST(ReadMesh, BadFilesAreInputErrors) {
  EXPECT_EQ(CodeOf(ReadMesh("")), "not-a-mesh");
  EXPECT_EQ(CodeOf(ReadMesh("<svg/>")), "not-a-mesh");
  EXPECT_EQ(CodeOf(ReadMesh("v 1 2\n")), "broken-mesh");
  EXPECT_EQ(CodeOf(ReadMesh("v 1 2 3\nf 1 1\n")), "broken-mesh");
  EXPECT_EQ(CodeOf(ReadMesh("ply\nelement vertex 99999999999\nend_header\n")), "broken-mesh");
  EXPECT_EQ(CodeOf(ReadMesh("glTF")), "broken-mesh");
  EXPECT_EQ(CodeOf(ReadMesh("PK\x03\x04")), "broken-mesh");
  const auto glb = [](std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto size = static_cast<char>(json.size());
    std::string file("glTF\2\0\0\0\0\0\0\0", 12);
    return file.append(1, size).append("\0\0\0JSON", 7).append(json);
  };
  EXPECT_EQ(CodeOf(ReadMesh(glb(R"({"extensionsRequired":["KHR_draco"]})"))), "unsupported-mesh");
  EXPECT_EQ(CodeOf(ReadMesh(glb(R"({"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]})"))),
            "broken-mesh");
  const Mesh mesh = SampleSphere(1);
  for (const auto& [ending, bytes] : Files())
    EXPECT_EQ(CodeOf(ReadMesh(bytes, {.max_triangles = 10})), "broken-mesh") << ending;
  EXPECT_EQ(CodeOf(ReadMesh(Files()["3mf"], {.max_unpacked = 1000})), "broken-mesh");
}

TEST(ReadMesh, EveryTruncatedOrDamagedFileIsReadOrRefused) {
  const ReadMeshOptions small{.max_triangles = 100'000, .max_unpacked = std::size_t{1} << 24};
  for (const auto& [ending, bytes] : Files()) {
    for (std::size_t n = 0; n < bytes.size(); n += 1 + n / 8) {
      const auto outcome = ReadMesh(bytes.substr(0, n), small);
      if (!outcome) {
        ASSERT_EQ(outcome.diagnostics().front().failure, FailureKind::kInput);
      }
    }
    ForSeeds(60, [&, &whole = bytes](Random& random) {
      std::string damaged = whole;
      const int last = static_cast<int>(std::min<std::size_t>(damaged.size(), 3000)) - 1;
      for (int i = 0; i < 4; ++i)
        damaged[static_cast<std::size_t>(random.Integer(0, last))] =
            static_cast<char>(random.Integer(0, 255));
      const auto outcome = ReadMesh(damaged, small);
      if (!outcome) {
        ASSERT_EQ(outcome.diagnostics().front().failure, FailureKind::kInput);
      }
      if (outcome) CheckMesh(outcome->mesh);
    });
  }
}

}  // namespace
}  // namespace lascaux
