// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/cluster/cluster_master.h"
#include "app/display/instructor_window.h"
#include "app/display/mouse_wand.h"
#include "app/display/view_headset.h"
#include "app/display/view_picture.h"
#include "app/display/view_windows.h"
#include "app/lesson/live_lesson.h"
#include "app/live/view_head.h"
#include "app/live/view_keys.h"
#include "app/view/live_sound.h"
#include "app/view/mouse_hand.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_panels.h"
#include "app/view/view_wand.h"
#include "core/clock.h"
#include "exhibit/exhibit_setup.h"
#include "exhibit/frame_builder.h"
#include "exhibit/journey.h"
#include "exhibit/procedure.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_hand.h"
#include "input/idle_watch.h"
#include "input/simulated_head.h"
#include "input/simulated_person.h"
#include "servo/frame_log.h"

namespace afm::app {

struct ViewSettings {
  HandSource hand = HandSource::Mouse;
  exhibit::HandControls device_controls = exhibit::HandControls::Device;  // of HandSource::Device
  double most_frames_per_s = 60.0;
  scene::ScaleMode scale = scene::ScaleMode::Fit;  // M goes on to the next
  std::optional<std::size_t> first_material;       // chosen whenever a servo has been started
  std::string frame_log;                           // a file; empty: none is written
  std::vector<input::HeadKey> head_script;         // of a head that no tracker follows; may be empty
  bool unattended = false;    // keys of staff are locked; without a visitor it begins again and shows itself
  double idle_s = 60;         // without a visitor, until then
  std::string record_folder;  // for the sessions of what is felt; empty: none is kept
  LiveSoundSettings sound;
  ViewHeadset* headset = nullptr;          // that shows the picture, and must outlive it; none
  ClusterMaster* cluster = nullptr;        // the other machines of the wall, which must outlive it; none
  LiveLesson* lesson = nullptr;            // that guides through the window, and must outlive it; none
  InstructorWindow* instructor = nullptr;  // of a lesson, the same
};

// The live window: a person's mouse points, chooses and moves the hand of the servo; every frame shows the newest state
// of the tip. Main thread only.
class LiveView {
 public:
  // All but the settings must outlive it.
  LiveView(const exhibit::Stage& stage, const std::vector<curves::SampleModel>& materials, ViewWindows& windows,
           ViewPicture& picture, ServoSupervisor::Starter start_servo, ViewWand& view_wand, const core::Clock& clock,
           const ViewSettings& settings);

  // Runs until a window is closed, Escape, SIGINT or SIGTERM. Fails when the servo cannot be started, at the end if it
  // has died and was not started again, and at once, with the servo ended in order, if the graphics device or the
  // display is lost.
  core::Result<void> run();

 private:
  friend struct LiveKeyTable;  // whose handlers act on what follows

  void begin_with(servo::ServoClient& servo, std::optional<std::size_t> felt_before);
  void run_frame(std::int64_t now_ns);
  void handle(const ViewEvent& input, std::int64_t now_ns);
  void press_key(render::Key key);
  static constexpr std::int64_t kForceTakenNs = 500'000'000;  // until a choice has taken the force away

  void press(const Pointed& pointed, const input::Ray& ray);
  void follow_wand(std::int64_t now_ns);
  void follow_head(std::int64_t now_ns);
  void follow_headset();
  std::function<void()> heartbeat();  // of one frame
  void choose(std::size_t material);  // that there is
  void follow_visitor(const ViewInput& input, std::int64_t now_ns);
  void begin_for_visitors();
  void demonstrate_next();
  bool hand_was_used();
  void next_scale();
  void take_force_away(std::int64_t now_ns);
  void travel(std::int64_t now_ns);
  void begin_again();
  void stop_force();
  void bring_to_wall();
  double before_wall_m() const;  // where the contact point is
  void bring_home();
  void move_head(double right_m, double up_m, double nearer_m);
  void turn_journey_round();
  void toggle_analogy();
  void toggle_scan();
  void toggle_truth();
  void toggle_friction_loop();
  void begin_scan();
  void end_scan();
  void next_scan_hand();
  void toggle_scan_feedback();
  std::optional<exhibit::HandPart> hand_part(const exhibit::ScanSubject& subject) const;
  exhibit::HandSize hand_size() const;
  bool scan_has_hand() const;
  void follow_scan(std::int64_t now_ns);
  void go_with_scan(double frame_s);
  void give_hand_back();
  void paint_with(const scene::TipSample& sample);
  void follow_sound();
  void toggle_picture();
  void number(std::size_t number);
  void stop_or_go_on();
  void skip_step();
  void try_again();
  void follow_lesson(std::int64_t now_ns);
  void follow_instructor(std::int64_t now_ns);
  void instruct(exhibit::InstructorAction action, std::int64_t now_ns);
  void show_to_instructor(std::int64_t now_ns, const std::function<void()>& while_waiting);
  std::optional<exhibit::LessonTarget> lesson_target_at(const input::Ray& ray) const;
  void press_in_lesson(const input::Ray& ray, const Pointed& pointed);
  void hide_sample(exhibit::Moment& now) const;
  void add_lesson(render::FrameState& frame);
  std::optional<std::string> lesson_guidance(const exhibit::Phrases& phrases) const;
  std::string spoken_guidance();
  void mark_next_setting();
  void step_setting(int steps);

  double hand_m_per_px(std::size_t window) const;
  HandSource hand() const;
  bool has_own_hand() const;
  exhibit::Controls controls() const;
  void move_hand(const ViewInput& input, std::int64_t now_ns);
  void follow_edits();
  Pointed pointed_at(std::size_t window, const glm::dvec2& cursor_px);
  bool wand_points() const;
  Pointed wand_pointed_at();
  exhibit::Moment moment(const Pointed& pointed, std::int64_t now_ns);
  exhibit::Hint next_hint(std::int64_t now_ns);
  std::string guidance(const exhibit::Phrases& phrases) const;
  std::optional<std::string> scan_guidance(const exhibit::Phrases& phrases) const;
  void record(const exhibit::Moment& now);
  exhibit::Moment share(const exhibit::Moment& now, const Pointed& pointed, cluster::FrameMessage& message);
  void share_scan();
  void share_built(const cluster::FrameMessage& message, render::FrameState& frame);
  void draw(const ViewInput& input, std::int64_t now_ns);
  void log_frame(std::int64_t begun_ns, std::int64_t presented_ns, std::optional<double> head_latency_s);
  void pace(std::int64_t frame_start_ns) const;

  const exhibit::Stage& stage_;
  ViewWindows& windows_;
  const core::Clock& clock_;
  ViewSettings settings_;
  std::vector<curves::SampleModel> felt_;  // as the servo feels them
  exhibit::FrameBuilder frames_;
  std::vector<input::Target> swatches_;
  ViewPicture& picture_;
  ViewPanels panels_;
  LiveSound sound_;  // before the servo, whose listener it hears
  ServoSupervisor servo_;
  MouseWand wand_;
  ViewWand& view_wand_;  // in its place, if there is one
  ViewHead head_;
  input::SimulatedHead simulated_head_;  // where no tracker follows a true one
  MouseHand hand_;
  input::SimulatedPerson person_;  // moves the hand with HandSource::Simulated
  exhibit::Procedure procedure_;
  exhibit::Hint hint_ = exhibit::Hint::ChooseSample;  // of this frame
  std::string logged_guidance_;
  std::int64_t hand_moved_ns_ = 0;
  glm::dvec2 cursor_px_{0.0};
  std::int64_t cursor_moved_ns_ = 0;
  exhibit::JourneyTravel travel_;
  std::int64_t force_taken_ns_ = 0;  // by the journey, last
  bool analogy_ = false;
  std::optional<exhibit::LiveScan> scan_;
  std::size_t scanned_ = 0;      // the material of that scan
  std::uint64_t scans_ = 0;      // that were begun
  std::int64_t scanned_ns_ = 0;  // until when it has been scanned
  scene::ScanHand scan_hand_ = scene::ScanHand::Apart;
  bool scan_feedback_ = true;
  exhibit::HandSize scan_size_;  // with which it was begun
  exhibit::LeadingScan leading_;
  scene::HandScript scan_script_;  // of the simulated hand
  glm::dvec3 scan_aim_m_{0.0};
  double scan_way_s_ = 0;    // of its way over the sample
  glm::dmat4 to_wall_{1.0};  // brings the scene to the wall, after the wand's navigation
  std::unique_ptr<servo::FrameLog> frame_log_;
  servo::ServoLateness servo_lateness_;
  input::IdleWatch visitor_;
  glm::dvec3 hand_seen_m_{0.0};  // of a device that a hand moves, at its last motion
  std::int64_t wand_seen_ns_ = 0;
  glm::dvec2 cursor_seen_px_{0.0};
  ClusterMaster* cluster_;
  LiveLesson* lesson_;
  InstructorWindow* instructor_;
  bool hand_off_ = false;  // the instructor keeps the force away
  std::optional<std::int64_t> stop_asked_ns_;
  std::string lesson_said_, lesson_line_;     // spoken words of the newest prompt, and the guidance behind them
  std::optional<std::int64_t> felt_ring_ns_;  // begin of the newest ring of light that a headset's controller has felt
  bool blank_ = false;                        // for who goes by ear and hand
  bool leaving_ = false;
};

}  // namespace afm::app
