#include "lascaux/io/load_plugin.h"

#include <gtest/gtest.h>

namespace lascaux {
namespace {

TEST(LoadPlugin, AMissingPluginIsAnErrorThatNamesThePlaces) {
  const auto symbol = LoadPlugin({.file = "lascaux_nothing.so", .symbol = "nothing"});
  ASSERT_FALSE(symbol.ok());
  EXPECT_EQ(symbol.diagnostics()[0].code, "plugin-missing");
  EXPECT_EQ(symbol.diagnostics()[0].failure, FailureKind::kOutput);
  EXPECT_NE(symbol.diagnostics()[0].message.find("lascaux_nothing.so"), std::string::npos);
  EXPECT_NE(symbol.diagnostics()[0].message.find("/lib"), std::string::npos);
}

}  // namespace
}  // namespace lascaux
