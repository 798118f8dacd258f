#include <lore/figure/svg.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace lore {

namespace {

/// Length of the valid UTF-8 sequence at the start of `bytes`, 0 if there is none.
std::size_t sequence_length(std::string_view bytes) {
    auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    std::size_t length = 0;
    if (byte(0) < 0x80) length = 1;
    else if (byte(0) >= 0xc2 && byte(0) < 0xe0) length = 2;
    else if (byte(0) >= 0xe0 && byte(0) < 0xf0) length = 3;
    else if (byte(0) >= 0xf0 && byte(0) < 0xf5) length = 4;
    if (length > bytes.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    // Overlong forms, surrogates, beyond U+10FFFF, and the two non-characters that XML forbids.
    if (length == 3 && ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f))) return 0;
    if (length == 3 && byte(0) == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe) return 0;
    if (length == 4 && ((byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f))) return 0;
    return length;
}

/// The text's first character, or byte where there is none. Precondition: the text is not empty.
std::string_view first_letter(std::string_view text) {
    return text.substr(0, std::max<std::size_t>(1, sequence_length(text)));
}

/// Of a letter in DejaVu Sans, at size 1.
double letter_width(std::string_view letter) {
    static constexpr std::array<double, 95> ascii{
        // from the space on
        .318, .401, .460, .838, .636, .950, .780, .275, .390, .390, .500, .838, .318, .361, .318, .337,
        .636, .636, .636, .636, .636, .636, .636, .636, .636, .636, .337, .337, .838, .838, .838, .531,
        1.00, .684, .686, .698, .770, .632, .575, .775, .752, .295, .295, .656, .557, .863, .748, .787,
        .603, .787, .695, .635, .611, .732, .684, .989, .685, .611, .685, .390, .337, .390, .838, .500,
        .500, .613, .635, .550, .635, .615, .352, .635, .634, .278, .278, .579, .278, .974, .634, .612,
        .635, .635, .411, .521, .392, .634, .592, .818, .592, .592, .525, .636, .337, .636, .838};
    auto const place = static_cast<std::size_t>(static_cast<unsigned char>(letter.front())) - ' ';
    if (place < ascii.size()) return ascii[place];
    return letter >= "\xe1\x84\x80" ? 1 : 0.65;   // from U+1100 on, Hangul, most letters are as wide as high
}

/// Bytes of the longest beginning that is no wider than `most`, at least one letter.
std::size_t bytes_within(std::string_view text, double most, Label const& label) {
    std::size_t bytes = 0;
    double width = 0;
    while (bytes < text.size()) {
        std::string_view const letter = first_letter(text.substr(bytes));
        width += text_width(letter, label);
        if (bytes > 0 && width > most) break;
        bytes += letter.size();
    }
    return bytes;
}

std::string escaped(std::string_view content) {
    std::string out;
    while (!content.empty()) {
        std::size_t const length = sequence_length(content);
        char const c = content.front();
        if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '&') out += "&amp;";
        else if (c == '"') out += "&quot;";
        else if (length == 0 || static_cast<unsigned char>(c) < 0x20 || c == 0x7f) out += '?';
        else out += content.substr(0, length);
        content.remove_prefix(length == 0 ? 1 : length);
    }
    return out;
}

/// Two decimals, without trailing zeros: documents are a third smaller.
std::string number(double value) {
    assert(std::isfinite(value));
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string attributes(Paint const& paint) {
    std::string text = fmt::format(" fill=\"{}\"", paint.fill);
    if (paint.stroke != "none")
        text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", paint.stroke, number(paint.width));
    if (!paint.dashes.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", paint.dashes);
    if (paint.opacity != 1) text += fmt::format(" opacity=\"{}\"", number(paint.opacity));
    return text;
}

std::string coordinates(std::span<SvgPoint const> points) {
    std::string text;
    for (SvgPoint const& p : points) text += fmt::format("{}{},{}", text.empty() ? "" : " ", number(p.x), number(p.y));
    return text;
}

}   // namespace

double text_width(std::string_view content, Label const& label) {
    double width = 0;
    while (!content.empty()) {
        std::string_view const letter = first_letter(content);
        width += letter_width(letter);
        content.remove_prefix(letter.size());
    }
    return width * label.size * (label.bold ? 1.12 : 1);
}

std::vector<std::string> broken_into_lines(std::string_view content, double most, Label const& label) {
    std::vector<std::string> lines;
    for (;;) {
        std::size_t const fits = bytes_within(content, most, label);
        if (fits == content.size()) break;
        std::size_t const space = content.rfind(' ', fits);
        bool const at_space = space != std::string_view::npos && space > 0;
        lines.emplace_back(content.substr(0, at_space ? space : fits));
        content.remove_prefix(at_space ? space + 1 : fits);
    }
    lines.emplace_back(content);
    return lines;
}

SvgDocument::SvgDocument(double width, double height, std::string_view title) {
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
        "font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\" stroke-linejoin=\"round\">\n"
        "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        number(width), number(height), escaped(title));
}

void SvgDocument::line(SvgPoint from, SvgPoint to, Paint const& paint) {
    text_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", number(from.x), number(from.y),
                         number(to.x), number(to.y), attributes(paint));
}

void SvgDocument::polyline(std::span<SvgPoint const> points, Paint const& paint) {
    text_ += fmt::format("<polyline points=\"{}\"{}/>\n", coordinates(points), attributes(paint));
}

void SvgDocument::polygon(std::span<SvgPoint const> points, Paint const& paint) {
    text_ += fmt::format("<polygon points=\"{}\"{}/>\n", coordinates(points), attributes(paint));
}

void SvgDocument::circle(SvgPoint center, double radius, Paint const& paint) {
    text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", number(center.x), number(center.y),
                         number(radius), attributes(paint));
}

void SvgDocument::rect(SvgPoint corner, double width, double height, Paint const& paint) {
    text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", number(corner.x), number(corner.y),
                         number(width), number(height), attributes(paint));
}

void SvgDocument::text(SvgPoint at, std::string_view content, Label const& label) {
    static constexpr std::string_view anchors[] = {"start", "middle", "end"};
    text_ +=
        fmt::format("<text x=\"{0}\" y=\"{1}\" font-size=\"{2}\" fill=\"{3}\" text-anchor=\"{4}\"{5}{6}>{7}</text>\n",
                    number(at.x), number(at.y), number(label.size), label.color,
                    anchors[static_cast<int>(label.anchor)], label.bold ? " font-weight=\"bold\"" : "",
                    label.rotation != 0 ? fmt::format(" transform=\"rotate({} {} {})\"", number(label.rotation),
                                                      number(at.x), number(at.y))
                                        : "",
                    escaped(content));
}

void SvgDocument::text(SvgPoint at, std::span<std::string const> lines, double height, Label const& label) {
    for (std::string const& line : lines) {
        text(at, line, label);
        at.y += height;
    }
}

void SvgDocument::begin_clip(SvgPoint corner, double width, double height) {
    int const id = clips_++;
    text_ += fmt::format("<clipPath id=\"clip{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n"
                         "<g clip-path=\"url(#clip{})\">\n",
                         id, number(corner.x), number(corner.y), number(width), number(height), id);
}

void SvgDocument::end_group() { text_ += "</g>\n"; }

void SvgDocument::embed(SvgPoint corner, double scale, std::string_view element) {
    text_ += fmt::format("<g transform=\"translate({} {}) scale({:.6g})\">{}</g>\n", number(corner.x), number(corner.y),
                         scale, element);
}

std::string SvgDocument::finish() && { return std::move(text_) + "</svg>\n"; }

}   // namespace lore
