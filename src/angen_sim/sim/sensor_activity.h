#pragma once

namespace angen::sim {

/// Whether a sensor has to sample at its next due time, and why not. Everything that skips samples
/// (the scheduler, leaps, snapshots) uses this state.
class SensorActivity {
 public:
  enum class State {
    kActive,     // samples at each due time
    kSteady,     // its values stay as they are, and have not been published yet
    kRepeating,  // publishes its last reading again, without making it again
    kVarying,    // its readings differ by noise only; it samples until enough of them were alike
    kLazy,       // a LazyReading replaces its samples
  };

  State state() const { return state_; }
  bool steady() const { return state_ == State::kSteady || state_ == State::kRepeating; }
  bool lazy() const { return state_ == State::kLazy; }
  /// Whether its samples can be skipped until a change.
  bool skips() const { return state_ == State::kRepeating || state_ == State::kLazy; }
  /// Whether the last sample's values are those of the last published reading.
  bool published() const { return published_; }

  /// It has sampled. `steady`: a further sample has the same values, but for noise if `varies`.
  /// `same`: the values are those of the last published reading, with nothing else to publish.
  void sampled(bool steady, bool varies, bool same) {
    published_ = published_ && steady && !varies && same;
    state_ = !steady ? State::kActive : varies ? State::kVarying : State::kSteady;
    if (state_ == State::kSteady && published_) state_ = State::kRepeating;
  }

  /// Its last sample was published.
  void publish() {
    published_ = true;
    if (state_ == State::kSteady) state_ = State::kRepeating;
  }

  /// A due time at which none of its inputs had changed, or one had.
  void note_unchanged() { ++unchanged_; }
  void note_changed() { unchanged_ = 0; }

  /// Whether enough samples in a row were alike that none before matters, a reading depending on
  /// `memory` samples before it.
  bool settled(int memory) const { return unchanged_ > memory; }
  void become_lazy() { state_ = State::kLazy; }
  /// It samples again, after its lazy reading replaced its samples.
  void resume() { state_ = State::kVarying; }

 private:
  State state_ = State::kActive;
  bool published_ = false;
  int unchanged_ = 0;  // due times in a row
};

}  // namespace angen::sim
