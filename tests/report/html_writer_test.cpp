// SPDX-License-Identifier: MIT
#include "risorius/report/html_writer.h"

#include <gtest/gtest.h>

#include "risorius/report/markdown_html.h"

namespace risorius::report {
namespace {

std::string markdown(const std::string& text) {
    HtmlWriter html;
    write_markdown(html, text, 3);
    return html.html();
}

TEST(HtmlWriter, TextIsNeverMarkup) {
    HtmlWriter html;
    html.element("p", "a < b && \"c\" <script>alert('x')</script>", {{"title", "\" onclick=\"x"}});
    EXPECT_EQ(html.html(),
              "<p title=\"&quot; onclick=&quot;x\">a &lt; b &amp;&amp; &quot;c&quot; "
              "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;</p>\n");
}

TEST(HtmlWriter, APageIsWholeAndAsksNothingOfTheNetwork) {
    HtmlWriter html;
    html.element("h1", "Title");
    const std::string page = html_page("A & B", html);
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n"));
    EXPECT_TRUE(page.ends_with("<h1>Title</h1>\n</main>\n</body>\n</html>\n"));
    EXPECT_NE(page.find("<title>A &amp; B</title>"), std::string::npos);
    for (const char* outside : {"http:", "https:", "<script", "@import", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(Markdown, HeadingsStartWhereTheyAreAskedTo) {
    EXPECT_EQ(markdown("# One\n\n## Two\n"), "<h3>One</h3>\n<h4>Two</h4>\n");
    EXPECT_EQ(markdown("#hashtag"), "<p>#hashtag</p>\n");
}

TEST(Markdown, ParagraphsJoinTheirLines) {
    EXPECT_EQ(markdown("one\ntwo\n\nthree"), "<p>one two</p>\n<p>three</p>\n");
}

TEST(Markdown, MarksInsideOfText) {
    EXPECT_EQ(markdown("**strong `a*b*`** and *soft* but 2 * 3 * 4 and `x < y`"),
              "<p><strong>strong <code>a*b*</code></strong> and <em>soft</em> but 2 * 3 * 4 and "
              "<code>x &lt; y</code></p>\n");
}

TEST(Markdown, OnlyLinksToTheWebAreLinks) {
    EXPECT_EQ(markdown("[site](https://a.example/?b=1&c) [file](../x.json) ![picture](p.png)"),
              "<p><a href=\"https://a.example/?b=1&amp;c\">site</a> file picture</p>\n");
    EXPECT_EQ(markdown("[bad](javascript:alert(1))").find("href"), std::string::npos);
}

TEST(Markdown, ListsAndTheirLongItems) {
    EXPECT_EQ(markdown("- one\n  goes on\n- two\n\n1. first\n2. second\n"),
              "<ul><li>one goes on</li>\n<li>two</li>\n</ul>\n"
              "<ol><li>first</li>\n<li>second</li>\n</ol>\n");
}

TEST(Markdown, TablesWithAHead) {
    EXPECT_EQ(markdown("| a | b |\n|---|--:|\n| 1 | `x|y` |\n"),
              "<div class=\"scroll\"><table><tr><th>a</th>\n<th>b</th>\n</tr>\n"
              "<tr><td>1</td>\n<td><code>x|y</code></td>\n</tr>\n</table>\n</div>\n");
}

TEST(Markdown, CodeIsKeptAsItIs) {
    EXPECT_EQ(markdown("    a  <b>\n    **c**\n"),
              "<pre><code>a  &lt;b&gt;\n**c**\n</code></pre>\n");
    EXPECT_EQ(markdown("```json\n{\"a\": 1}\n```\nafter"),
              "<pre><code>{&quot;a&quot;: 1}\n</code></pre>\n<p>after</p>\n");
}

TEST(Markdown, WhatIsNotClosedEndsAnyway) {
    for (const char* text : {"```\nopen", "**open", "[open](", "`", "|", "| a", "- ", "1.", "#",
                             "![", "*", "", "\n\n", "[a\n](b)"})
        EXPECT_NO_THROW(markdown(text)) << text;
    EXPECT_EQ(markdown("|"),
              "<div class=\"scroll\"><table><tr><td></td>\n</tr>\n</table>\n</div>\n");
}

}  // namespace
}  // namespace risorius::report
