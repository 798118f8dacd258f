#include <lore/figure/svg.h>

#include <lore/core/error.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

namespace lore {

namespace {

constexpr double largest_edge = 16384;   // [pixels]

struct Release {
    void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};

[[noreturn]] void fail(std::string_view reason) {
    throw Error("cannot render a picture as PNG", reason, "The SVG file beside it holds the same picture.");
}

std::string message_of(GError* error) {
    std::string message = error != nullptr ? error->message : "librsvg gives no reason";
    if (error != nullptr) g_error_free(error);
    while (message.ends_with('\n')) message.pop_back();
    return message;
}

std::unique_ptr<RsvgHandle, Release> parse(std::string_view svg, GError** error) {
    return std::unique_ptr<RsvgHandle, Release>{
        rsvg_handle_new_from_data(reinterpret_cast<guint8 const*>(svg.data()), svg.size(), error)};
}

cairo_status_t append(void* out, unsigned char const* data, unsigned length) {
    static_cast<std::string*>(out)->append(reinterpret_cast<char const*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

}   // namespace

std::string why_no_svg(std::string_view text) {
    GError* error = nullptr;
    return parse(text, &error) ? std::string{} : message_of(error);
}

std::string render_png(std::string_view svg, double scale) {
    GError* error = nullptr;
    auto const handle = parse(svg, &error);
    if (!handle) fail(message_of(error));
    double width = 0, height = 0;
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height)) fail("it has no size in pixels");
    if (!(width > 0 && height > 0)) fail(fmt::format("{} x {} pixels", width, height));
    scale = std::min({scale, largest_edge / width, largest_edge / height});
    width = std::min(std::ceil(width * scale), largest_edge);
    height = std::min(std::ceil(height * scale), largest_edge);

    std::unique_ptr<cairo_surface_t, Release> const surface{
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height))};
    std::unique_ptr<cairo_t, Release> const context{cairo_create(surface.get())};
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    RsvgRectangle const viewport{0, 0, width, height};
    if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error)) fail(message_of(error));
    std::string png;
    if (cairo_status_t const status = cairo_surface_write_to_png_stream(surface.get(), append, &png);
        status != CAIRO_STATUS_SUCCESS)
        fail(cairo_status_to_string(status));
    return png;
}

}   // namespace lore
