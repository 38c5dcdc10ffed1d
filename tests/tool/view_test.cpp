// SPDX-License-Identifier: Apache-2.0
// What `view` writes and refuses. What it serves is tested in a browser (tests/web).
#include <gmock/gmock.h>

#include "tests/tool/run.h"
#include "tool/viewer_page.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using tool::Exit;
using View = ToolTest;

TEST_F(View, RefusesWhatIsNoStreamAndNamesThatAreNoPages) {
  write(path("a.txt"), "no stream");
  EXPECT_EQ(run({"view", path("a.txt"), "--no-open"}).exit, Exit::kBadInput);
  EXPECT_EQ(run({"view", path("nowhere.limber"), "--no-open"}).exit, Exit::kBadInput);
  const Ran ran = run({"view", stream(), "--export", path("a.txt")});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  EXPECT_THAT(ran.err, HasSubstr(".html"));
  EXPECT_EQ(run({"view", path("a.limber"), "-f"}).exit, Exit::kUsage);
  EXPECT_EQ(run({"view", path("a.limber"), "--port", "70000"}).exit, Exit::kUsage);
}

TEST_F(View, ExportsAPageWithTheStreamInside) {
  const std::string file = stream();
  if (!tool::read_viewer_page()) {
    const Ran refused = run({"view", file, "--export", path("a.html")});
    EXPECT_EQ(refused.exit, Exit::kBadInput);
    EXPECT_THAT(refused.err, HasSubstr("scripts/setup web"));
    GTEST_SKIP() << "built without the viewer";
  }
  const Ran ran = run({"view", file, "--export", path("a.html"), "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["schema"], "limber.view/1");
  const std::string page = bytes(path("a.html"));
  EXPECT_EQ(ran.json()["bytes"], page.size());
  EXPECT_THAT(page, StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("data-name=\"a.limber\">iUxNQlINChoC"));
  EXPECT_EQ(run({"view", file, "--export", path("a.html")}).exit, Exit::kFailure);
  EXPECT_EQ(run({"view", file, "--export", path("a.html"), "-f"}).exit, Exit::kDone);
}

TEST(ViewerPage, HoldsTheBytesAsBase64AndTheNameAsAnAttribute) {
  const auto with = [](std::string_view text, std::string_view name) {
    return tool::with_stream("<a><!-- stream --><b>", std::as_bytes(std::span(text)), name);
  };
  const std::string begin = "<a><script type=\"text/plain\" id=\"limber-stream\" data-name=\"";
  EXPECT_EQ(with("", "x"), begin + "x\"></script><b>");
  EXPECT_EQ(with("f", "x"), begin + "x\">Zg==</script><b>");
  EXPECT_EQ(with("fo", "x"), begin + "x\">Zm8=</script><b>");
  EXPECT_EQ(with("foo", "x"), begin + "x\">Zm9v</script><b>");
  EXPECT_EQ(with("foob\xff\xfe", "\"<&"), begin + "&quot;&lt;&amp;\">Zm9vYv/+</script><b>");
}

}  // namespace
}  // namespace limber::test
