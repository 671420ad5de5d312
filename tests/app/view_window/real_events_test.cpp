// The program's window driven by real events of the X server (XTEST), as by a hand. The same events go to a
// controller without a window; what the window saved, drew and exported is compared with it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "app/view/window/controller.hpp"
#include "kernel/exchange/picture.hpp"
#include "tests/app/view_window/viewing.hpp"

// Last, since X defines words such as None and Success.
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>

namespace blendwright::test {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto patience = 60s;  // for a busy machine; a step takes some 0.1 s
constexpr int width = 720, height = 540;
const fs::path job = fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs/branch-to-main.json";

/// The connection to the display that DISPLAY names.
class Server {
 public:
  Server() : display_(::XOpenDisplay(nullptr)) {}
  ~Server() {
    if (display_) ::XCloseDisplay(display_);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  [[nodiscard]] ::Display* get() const { return display_; }
  [[nodiscard]] bool has_test_events() const {
    int event = 0, error = 0, major = 0, minor = 0;
    return display_ && ::XTestQueryExtension(display_, &event, &error, &major, &minor);
  }

 private:
  ::Display* display_;
};

/// The program in a window, and a controller that gets the same events.
class Shown {
 public:
  Shown(const Server& server, const fs::path& file, const fs::path& save) : x_(server.get()) {
    start(file, save);
    find_window();
    // Its files are its own: what the program wrote stays what it wrote.
    fs::copy_file(file, own_ / file.filename());
    std::vector<std::unique_ptr<Document>> documents;
    documents.push_back(open_document(own_ / file.filename()));
    twin_ = std::make_unique<Controller>(std::move(documents), Controller::Files{own_ / "saved.json", true},
                                         width, height);
    twin_->set_picture_writer([](const fs::path&) {});
  }
  ~Shown() {
    if (code_ < 0) {
      ::kill(program_, SIGKILL);
      ::waitpid(program_, nullptr, 0);
    }
  }
  Shown(const Shown&) = delete;
  Shown& operator=(const Shown&) = delete;

  [[nodiscard]] Controller& twin() { return *twin_; }
  [[nodiscard]] std::string saved_by_twin() const { return content(own_ / "saved.json"); }
  [[nodiscard]] std::string title() const {
    char* name = nullptr;
    if (!::XFetchName(x_, window_, &name) || !name) return {};
    const std::string text = name;
    ::XFree(name);
    return text;
  }

  void motion(const Vec2& at) {
    const auto [x, y] = pixel(at);
    event([&, x = x, y = y] { ::XTestFakeMotionEvent(x_, -1, x, y, CurrentTime); });
    twin_->move(centre(at));
  }
  void button(bool down, const Vec2& at, bool shift = false) {
    event([&] { ::XTestFakeButtonEvent(x_, 1, down, CurrentTime); });
    if (down)
      twin_->press(Controller::Button::left, centre(at), shift);
    else
      twin_->release(centre(at));
  }
  void drag(const Vec2& from, const Vec2& to, bool shift = false) {
    motion(from);
    if (shift) raw_key(XK_Shift_L, true);
    button(true, from, shift);
    for (int i = 1; i <= 5; ++i) motion(from + (to - from) * i / 5.0);
    button(false, to);
    if (shift) raw_key(XK_Shift_L, false);
  }
  void click(const Vec2& at) {
    motion(at);
    button(true, at);
    button(false, at);
  }
  void key(KeySym symbol, const std::string& name, bool control = false) {
    if (control) raw_key(XK_Control_L, true);
    raw_key(symbol, true);
    raw_key(symbol, false);
    if (control) raw_key(XK_Control_L, false);
    twin_->key(name, control);
  }
  /// What a window manager sends when a person closes the window.
  void ask_to_close() {
    XEvent e{};
    e.xclient.type = ClientMessage;
    e.xclient.window = window_;
    e.xclient.message_type = ::XInternAtom(x_, "WM_PROTOCOLS", False);
    e.xclient.format = 32;
    e.xclient.data.l[0] = static_cast<long>(::XInternAtom(x_, "WM_DELETE_WINDOW", False));
    event([&] { ::XSendEvent(x_, window_, False, NoEventMask, &e); });
  }
  /// The exit code once the program has ended; -1: it has not.
  [[nodiscard]] int exit_code(std::chrono::seconds limit = patience) {
    const auto end = Clock::now() + limit;
    int status = 0;
    while (code_ < 0 && Clock::now() < end) {
      if (::waitpid(program_, &status, WNOHANG) == program_)
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      else
        std::this_thread::sleep_for(5ms);
    }
    return code_;
  }
  /// What is on the screen where the window is, rows from the bottom.
  [[nodiscard]] Pixels screen() const {
    XImage* image = ::XGetImage(x_, window_, 0, 0, width, height, AllPlanes, ZPixmap);
    Pixels p{width, height, {}};
    for (int y = height - 1; y >= 0; --y)
      for (int x = 0; x < width; ++x) {
        const unsigned long c = XGetPixel(image, x, y);
        for (const int shift : {16, 8, 0}) p.rgb.push_back(static_cast<unsigned char>((c >> shift) & 255));
      }
    XDestroyImage(image);
    return p;
  }

 private:
  void start(const fs::path& file, const fs::path& save) {
    program_ = ::fork();
    if (program_ != 0) return;
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int fd : {0, 1, 2}) ::dup2(nothing, fd);
    ::execl(BLENDWRIGHT_PROGRAM, BLENDWRIGHT_PROGRAM, "view", file.c_str(), "--save", save.c_str(), "--width",
            std::to_string(width).c_str(), "--height", std::to_string(height).c_str(), "--force", nullptr);
    ::_exit(127);
  }
  void find_window() {
    const auto end = Clock::now() + patience;
    while (Clock::now() < end) {
      ::Window root = 0, parent = 0, *children = nullptr;
      unsigned int count = 0;
      ::XQueryTree(x_, DefaultRootWindow(x_), &root, &parent, &children, &count);
      for (unsigned int i = 0; i < count; ++i) {
        window_ = children[i];
        if (title().find("blendwright") != std::string::npos) break;
        window_ = 0;
      }
      if (children) ::XFree(children);
      if (window_) break;
      std::this_thread::sleep_for(20ms);
    }
    if (!window_) throw std::runtime_error("the program shows no window");
    ::XSelectInput(x_, window_, PropertyChangeMask);
    XWindowAttributes attributes;
    do {
      ::XGetWindowAttributes(x_, window_, &attributes);
      std::this_thread::sleep_for(20ms);
    } while (attributes.map_state != IsViewable && Clock::now() < end);
    ::XSetInputFocus(x_, window_, RevertToParent, CurrentTime);
    int x = 0, y = 0;
    ::Window child = 0;
    ::XTranslateCoordinates(x_, window_, DefaultRootWindow(x_), 0, 0, &x, &y, &child);
    left_ = x;
    top_ = y;
  }
  /// Every event is drawn, and every drawing writes the title: then it has been handled.
  template <class Send>
  void event(Send send) {
    ::XSync(x_, False);
    XEvent e;
    while (::XCheckTypedEvent(x_, PropertyNotify, &e)) continue;
    send();
    ::XFlush(x_);
    const auto end = Clock::now() + patience;
    while (!::XCheckTypedEvent(x_, PropertyNotify, &e) && Clock::now() < end && exit_code(0s) < 0)
      std::this_thread::sleep_for(1ms);
  }
  void raw_key(KeySym symbol, bool down) {
    // A key that is let go is not drawn.
    const auto send = [&] { ::XTestFakeKeyEvent(x_, ::XKeysymToKeycode(x_, symbol), down, CurrentTime); };
    if (down) return event(send);
    send();
    ::XSync(x_, False);
  }
  /// The window counts pixels from its lower left corner, X from the upper left one.
  [[nodiscard]] std::pair<int, int> pixel(const Vec2& at) const {
    return {left_ + static_cast<int>(at.x()), top_ + height - 1 - static_cast<int>(at.y())};
  }
  [[nodiscard]] static Vec2 centre(const Vec2& at) {
    return {std::floor(at.x()) + 0.5, std::floor(at.y()) + 0.5};
  }

  ::Display* x_;
  const Folder own_;
  pid_t program_ = -1;
  int code_ = -1, left_ = 0, top_ = 0;
  ::Window window_ = 0;
  std::unique_ptr<Controller> twin_;
};

class RealEvents : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(display_.available()) << display_.reason();
    server_ = std::make_unique<Server>();
    ASSERT_TRUE(server_->has_test_events());
  }
  /// Where the slider stands, and where it stands for `value`.
  static std::pair<Vec2, Vec2> slider(Controller& c, const std::string& label, double value) {
    const PixelBox track = c.reveal(label);
    const double y = 0.5 * (track.bottom + track.top);
    for (SessionControl control : c.controls()) {
      if (control.label != label) continue;
      const double from = Controller::pixel_of(control, track);
      control.value = value;
      return {{from, y}, {Controller::pixel_of(control, track), y}};
    }
    throw std::out_of_range(label);
  }
  static Vec2 place_of(const Controller& c, SessionHandle::Kind kind, std::size_t side, std::size_t index) {
    for (const SessionHandle& h : c.handles())
      if (h.kind == kind && h.side == side && h.index == index)
        return c.state().camera.pixel(h.position, c.layout().panes.front());
    throw std::out_of_range("no such handle");
  }
  static double worst_gap(const Controller& c) { return c.document().errors()->gap; }

  const blendwright::Display display_;
  std::unique_ptr<Server> server_;
  const Folder folder_;
};

TEST_F(RealEvents, ShapeSaveDrawAndExportAsWithoutAWindow) {
  fs::copy_file(job, folder_ / "job.json");
  Shown shown(*server_, folder_ / "job.json", folder_ / "saved.json");
  Controller& twin = shown.twin();
  for (const auto& [label, value] :
       {std::pair{"tension", 6.0}, std::pair{"magnitude from", 1.4}, std::pair{"magnitude to", 0.7}}) {
    const auto [from, to] = slider(twin, label, value);
    shown.drag(from, to);
  }
  for (const auto& [label, value] : {std::pair{"mode", 1.0}, std::pair{"continuity from", 1.0},
                                     std::pair{"continuity to", 1.0}, std::pair{"mode", 0.0}})
    shown.click(slider(twin, label, value).second);
  const Vec2 magnitude = place_of(twin, SessionHandle::Kind::magnitude, 0, 6);
  shown.drag(magnitude, magnitude + Vec2(0.0, -14.0));
  const Vec2 line = place_of(twin, SessionHandle::Kind::trimline, 1, 6);
  shown.drag(line, line + Vec2(9.0, -6.0), true);
  const Vec2 whole = place_of(twin, SessionHandle::Kind::trimline, 0, 6);
  shown.drag(whole, whole + Vec2(0.0, 7.0));
  shown.key(XK_z, "z", true);
  shown.key(XK_y, "y", true);
  shown.key(XK_z, "z", true);
  EXPECT_EQ(shown.title(), "job.json* - blendwright");
  EXPECT_LE(worst_gap(twin), 1e-12);

  shown.click(line + Vec2(-30.0, 30.0));
  shown.key(XK_5, "5");
  shown.key(XK_h, "h");
  shown.key(XK_Escape, "Escape");
  shown.key(XK_s, "s", true);
  EXPECT_EQ(shown.title(), "job.json - blendwright");
  const std::string saved = content(folder_ / "saved.json");
  EXPECT_EQ(saved, shown.saved_by_twin());
  EXPECT_NE(saved, content(job));
  EXPECT_NE(saved.find("\"shift\""), std::string::npos);
  EXPECT_NE(saved.find("\"tension\""), std::string::npos);

  shown.key(XK_e, "e");
  const Outcome apart =
      run_program("compare " + quoted_path(folder_ / "saved.json") + " " +
                  quoted_path(folder_ / "job-edited.step") + "#fillet --limit 1e-4 --quiet");
  EXPECT_EQ(apart.code, 0) << apart.err;
  const Outcome verified = run_program("verify " + quoted_path(folder_ / "saved.json") + " --quiet");
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  const Pixels before = shown.screen();
  shown.key(XK_p, "p");
  shown.key(XK_q, "q");
  ASSERT_EQ(shown.exit_code(), 0);
  const Pixels picture = read_png(folder_ / "job.png");
  ASSERT_EQ(picture.width, width);
  ASSERT_EQ(picture.height, height);
  std::size_t other = 0;
  for (int y = 50; y < height; ++y)  // above the status lines, which tell of the picture
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) other += std::abs(picture.at(x, y)[c] - before.at(x, y)[c]) > 8;
  EXPECT_LT(other, picture.rgb.size() / 1000);
}

TEST_F(RealEvents, ClosingTheWindowAsksOnceWhenChangesAreNotSaved) {
  fs::copy_file(job, folder_ / "job.json");
  Shown shown(*server_, folder_ / "job.json", folder_ / "saved.json");
  const auto [from, to] = slider(shown.twin(), "tension", 6.0);
  shown.drag(from, to);
  shown.ask_to_close();
  EXPECT_EQ(shown.exit_code(1s), -1) << "changes are lost";
  shown.key(XK_s, "s", true);
  EXPECT_TRUE(fs::exists(folder_ / "saved.json"));
  shown.ask_to_close();
  EXPECT_EQ(shown.exit_code(), 0);
}

}  // namespace
}  // namespace blendwright::test
