#include <lore/watch/answer.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

WebAnswer answer(WebRequest const& request) {
    WatchDocuments documents;
    documents.publish("{\"title\": 1}", "[]");
    return documents.answer(request);
}

}   // namespace

TEST(WatchAnswer, to_a_get_from_this_machine_is_a_document) {
    WebAnswer const page = answer({"GET", "/", "127.0.0.1:8017"});
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.type, "text/html; charset=utf-8");
    EXPECT_THAT(*page.body, HasSubstr("<!DOCTYPE html>"));
    EXPECT_EQ(*answer({"GET", "/facts.json", "localhost"}).body, "{\"title\": 1}");
    EXPECT_EQ(*answer({"GET", "/replay.json", "[::1]:80"}).body, "[]");
}

TEST(WatchAnswer, to_another_host_is_403_whatever_it_asks_for) {
    for (char const* host :
         {"", "example.org", "127.0.0.1.example.org", "localhost.example.org:8017", "localhost:80:80",
          "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:123456", "[::1", "::1", "localhost ", "192.168.0.1"})
        for (char const* path : {"/", "/facts.json", "/nothing"})
            EXPECT_EQ(answer({"GET", path, host}).status, 403) << host << path;
}

TEST(WatchAnswer, knows_its_host_in_any_case_and_at_any_port) {
    for (char const* host : {"LocalHost", "localhost:1", "127.0.0.1:65535", "[::1]", "[::1]:9000"})
        EXPECT_TRUE(is_loopback(host)) << host;
}

TEST(WatchAnswer, to_another_method_is_405) {
    for (char const* method : {"POST", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "get", ""})
        EXPECT_EQ(answer({method, "/", "localhost"}).status, 405) << method;
}

TEST(WatchAnswer, to_another_path_is_404_since_no_path_is_a_file) {
    for (char const* path :
         {"/../../etc/passwd", "//facts.json", "/facts.json/", "/watch.html", "/runs", "", "facts.json"})
        EXPECT_EQ(answer({"GET", path, "localhost"}).status, 404) << path;
    EXPECT_EQ(WatchDocuments{}.answer({"GET", "/facts.json", "localhost"}).status, 404) << "before the first look";
}

TEST(WatchAnswer, loads_nothing_from_elsewhere_and_makes_no_html_of_text) {
    std::string const page = *answer({"GET", "/", "localhost"}).body;
    for (char const* foreign :
         {"https:", "src=", "@import", "innerHTML", "outerHTML", "insertAdjacent", "document.write", "eval(", "@LORE_"})
        EXPECT_THAT(page, Not(HasSubstr(foreign)));
}
