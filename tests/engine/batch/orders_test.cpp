// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/result_printing.h"
#include "support/run_program.h"
#include "toile/batch/batch.h"

namespace toile {
namespace {

using test::TemporaryFolder;
using test::writeText;
using testing::HasSubstr;

TEST(Orders, FolderGivesItsBodiesByName) {
  const TemporaryFolder folder;
  for (const char* name : {"zoe.PLY", "anna.obj", ".hidden.ply", "notes.txt", "ben.ply"}) {
    writeText(folder.path() / name, "");
  }
  writeText(folder.path() / "ben.model.json", "{}");
  const auto orders = readOrders(folder.path(), FileUnit::Millimetre);
  ASSERT_TRUE(orders) << orders.error();
  ASSERT_EQ(orders->size(), 3U);
  EXPECT_EQ((*orders)[0].name, "anna");
  EXPECT_THAT((*orders)[1].body, HasSubstr("ben.model.json"));
  EXPECT_EQ((*orders)[2].name, "zoe");
  EXPECT_EQ((*orders)[2].unit, FileUnit::Millimetre);
}

TEST(Orders, ListKeepsGoodRowsBesideBadOnes) {
  const TemporaryFolder folder;
  const auto list = folder.path() / "list.csv";
  writeText(list,
            "\xEF\xBB\xBF"
            "body,name,customer,units\r\n"
            "a.ply,Anna/1,\"A. \"\"Anna\"\", Kiel\",cm\r\n"
            "\r\n"
            "b.ply,Anna/1,,furlong\r\n"
            "c.ply,x\r\n"
            ",y,,\r\n");
  const auto orders = readOrders(list);
  ASSERT_TRUE(orders) << orders.error();
  ASSERT_EQ(orders->size(), 4U);
  EXPECT_EQ((*orders)[0].name, "Anna-1");
  EXPECT_EQ((*orders)[0].customer, "A. \"Anna\", Kiel");
  EXPECT_EQ((*orders)[0].body, (folder.path() / "a.ply").string());
  EXPECT_EQ((*orders)[0].unit, FileUnit::Centimetre);
  EXPECT_EQ((*orders)[0].refusal, "");
  EXPECT_EQ((*orders)[1].name, "Anna-1-2") << "folders must differ";
  EXPECT_THAT((*orders)[1].refusal, HasSubstr("line 4"));
  EXPECT_THAT((*orders)[2].refusal, HasSubstr("line 5: 2 cells"));
  EXPECT_THAT((*orders)[3].refusal, HasSubstr("line 6: it names no body"));
}

TEST(Orders, NoOrdersAreAnError) {
  const TemporaryFolder folder;
  const auto none = readOrders(folder.path());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::InvalidArgument);
  writeText(folder.path() / "list.csv", "body\n");
  const auto empty = readOrders(folder.path() / "list.csv");
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::FileFormat);
  EXPECT_EQ(readOrders(folder.path() / "no.csv").error().code, ErrorCode::FileNotFound);
}

TEST(Orders, KeyChangesWithWhatTheResultDependsOn) {
  const TemporaryFolder folder;
  const auto design = folder.path() / "d.toile", body = folder.path() / "b.ply";
  writeText(design, "one");
  writeText(body, "body");
  BatchOrder order;
  order.name = "b";
  order.body = body.string();
  const ContentHash first = *orderKey(design, order);
  EXPECT_EQ(first, *orderKey(design, order));
  BatchOrder other = order;
  other.customer = "Anna";
  EXPECT_NE(first, *orderKey(design, other));
  other = order;
  other.unit = FileUnit::Inch;
  EXPECT_NE(first, *orderKey(design, other));
  writeText(body, "another body");
  EXPECT_NE(first, *orderKey(design, order));
  writeText(body, "body");
  EXPECT_EQ(first, *orderKey(design, order));
  writeText(design, "two");
  EXPECT_NE(first, *orderKey(design, order));
}

}  // namespace
}  // namespace toile
