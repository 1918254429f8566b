#include "guard.h"

#include <gtest/gtest.h>

namespace keyline::studio {
namespace {

const Access kAccess{host_names("127.0.0.1", 8080, {}), "0123456789abcdef"};

RequestHead good() {
  RequestHead head;
  head.method = "POST";
  head.path = "/api/v1/lac.segment";
  head.host = "127.0.0.1:8080";
  head.authorization = "Bearer 0123456789abcdef";
  return head;
}

int status(const RequestHead& head) { return refusal(kAccess, head).status; }

TEST(Guard, LetsTheOwnPageIn) {
  RequestHead head = good();
  EXPECT_EQ(refusal(kAccess, head).reason, "");
  head.origin = "http://localhost:8080";
  head.host = "localhost:8080";
  head.fetch_site = "same-origin";
  EXPECT_EQ(refusal(kAccess, head).reason, "");
}

TEST(Guard, RefusesOtherNamesForThisAddress) {
  for (const char* host : {"", "evil.example", "evil.example:8080", "127.0.0.1", "127.0.0.1:80",
                           "127.0.0.1:8080.evil.example"}) {
    RequestHead head = good();
    head.host = host;
    EXPECT_EQ(status(head), 421) << host;
  }
}

TEST(Guard, RefusesPagesOfOtherSites) {
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:8081",
                             "http://127.0.0.1:8080.evil.example", "file://"}) {
    RequestHead head = good();
    head.origin = origin;
    EXPECT_EQ(status(head), 403) << origin;
  }
  for (const char* site : {"cross-site", "same-site"}) {
    RequestHead head = good();
    head.fetch_site = site;
    EXPECT_EQ(status(head), 403) << site;
  }
}

TEST(Guard, AsksForTheTokenOnEveryCall) {
  for (const char* given : {"", "Bearer", "Bearer ", "Bearer 0123456789abcdee", "0123456789abcdef",
                            "Bearer 0123456789abcdef0"}) {
    RequestHead head = good();
    head.authorization = given;
    EXPECT_EQ(status(head), 401) << given;
  }
  RequestHead page = good();
  page.method = "GET";
  page.path = "/";
  page.authorization = "";
  EXPECT_EQ(refusal(kAccess, page).reason, "");  // nothing in it is secret
}

TEST(Guard, TakesTheTokenOfASocketFromItsProtocols) {
  RequestHead head = good();
  head.method = "GET";
  head.path = "/api/v1/socket";
  head.authorization = "";
  head.protocols = "keyline.v1, token.0123456789abcdef";
  EXPECT_EQ(refusal(kAccess, head).reason, "");
  head.protocols = "keyline.v1, token.0123456789abcdee";
  EXPECT_EQ(status(head), 401);
}

TEST(Guard, KnowsTwoMethodsAndReadsThePageOnly) {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "HEAD", "CONNECT"}) {
    RequestHead head = good();
    head.method = method;
    EXPECT_EQ(status(head), 405) << method;
  }
  RequestHead page = good();
  page.path = "/index.html";
  EXPECT_EQ(status(page), 405);
}

TEST(Guard, MakesTokensThatDiffer) {
  EXPECT_EQ(make_token().size(), 32u);
  EXPECT_NE(make_token(), make_token());
}

}  // namespace
}  // namespace keyline::studio
