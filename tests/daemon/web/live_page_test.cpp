// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The files of the page: against the sources that they are made of, and against the promises of its
// headers.
#include "daemon/web/live_page.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/web/page_files.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string header(const HttpResponse& response, const std::string& name) {
    for (const auto& [known, value] : response.headers) {
        if (known == name) return value;
    }
    return {};
}

class Page : public testing::Test {
  protected:
    void SetUp() override {
        if (page_files().empty()) GTEST_SKIP() << "this build has no page";
    }
};

TEST_F(Page, HasTheBytesOfItsSources) {
    std::size_t sources = 0;
    for (const auto& entry : fs::directory_iterator(SCIPD_PAGE_SOURCES)) {
        const auto response = page_file(entry.path().filename().string(), {});
        EXPECT_EQ(response.status, 200) << entry.path();
        const bool is_bundled = entry.path().filename() == "main.js" &&
                                response.body.find("from\"./") == std::string::npos &&
                                response.body.find("from './") == std::string::npos;
        EXPECT_TRUE(is_bundled || response.body == content_of(entry.path())) << entry.path();
        ++sources;
    }
    EXPECT_GE(sources, 3U);
}

TEST_F(Page, FindsAllThatItImports) {
    EXPECT_THAT(page_file("three.module.js", {}).body, HasSubstr("export { "));
    const auto controls = page_file("OrbitControls.js", {}).body;
    EXPECT_THAT(controls, HasSubstr("from \"./three.module.js\""));
    EXPECT_THAT(controls, Not(HasSubstr("../")));
}

TEST_F(Page, IsSmall) {
    std::size_t bytes = 0;
    for (const PageFile& file : page_files())
        bytes += file.content.size();
    EXPECT_LT(bytes, 3U << 20U);
}

TEST_F(Page, TellsBrowsersWhatItsFilesAre) {
    EXPECT_EQ(page_file("index.html", {}).content_type, "text/html; charset=utf-8");
    EXPECT_EQ(page_file("main.js", {}).content_type, "text/javascript; charset=utf-8");
    EXPECT_EQ(page_file("icon.svg", {}).content_type, "image/svg+xml");
}

TEST_F(Page, FetchesNothingFromElsewhereAndIsNotFramed) {
    for (const PageFile& file : page_files()) {
        const auto response = page_file(file.name, {});
        EXPECT_THAT(header(response, "Content-Security-Policy"),
                    testing::AllOf(HasSubstr("default-src 'none'"), HasSubstr("script-src 'self';"),
                                   HasSubstr("frame-ancestors 'none'"), Not(HasSubstr("unsafe")),
                                   Not(HasSubstr("*"))));
        EXPECT_THAT(response.headers, Contains(Pair("X-Frame-Options", "DENY")));
    }
    EXPECT_THAT(
        page_file("index.html", {}).body,
        testing::AllOf(Not(HasSubstr("<style")), Not(HasSubstr("style=")),
                       Not(HasSubstr("<script>")), Not(testing::ContainsRegex(" on[a-z]+="))));
}

TEST_F(Page, IsNotSentAgainToThoseWhoHaveIt) {
    HttpRequest request;
    const auto first = page_file("main.js", request);
    const auto tag = header(first, "ETag");
    request.if_none_match = "\"other\", W/" + tag;
    const auto again = page_file("main.js", request);
    EXPECT_EQ(again.status, 304);
    EXPECT_EQ(again.body, "");
    EXPECT_EQ(header(again, "ETag"), tag);
    EXPECT_EQ(page_file("index.html", request).status, 200);
}

TEST(PageFile, IsNoOtherFile) {
    for (const char* name : {"", "..", "../live_page.cpp", "/etc/hostname", "index", "Index.html"})
        EXPECT_EQ(page_file(name, {}).status, 404) << name;
}

TEST(PagePath, IsOfThePageAlone) {
    for (const char* path : {"/", "/page/main.js", "/favicon.ico"})
        EXPECT_TRUE(is_of_page(path)) << path;
    for (const char* path : {"", "//", "/status", "/page", "/pages/x", "/scene", "/stream"})
        EXPECT_FALSE(is_of_page(path)) << path;
}

}  // namespace
}  // namespace scipd::daemon
