// librfid_tag.so
#include "plugin/registration.h"
#include "plugin/wiring.h"

namespace angen::devices {

/// An RFID tag on its model: an id, and where it sticks. It does nothing but be read.
class Tag : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    id_ = params.text("id", wiring.model(), "that readers read; the model's name unless given");
    position_ = params.row("position", position_, "m", "x y z in the model's frame");
  }

  void update(const View&, Outputs&) override {}
  Nanoseconds idle_until(const View&) const override { return kForever; }

  void report(const View&, Reading& state) const override {
    state.set("id", id_);
    state.set("position", position_);
  }

 private:
  std::string id_;
  std::vector<double> position_{0.0, 0.0, 0.0};
};

ANGEN_REGISTER_PART(Tag, model.name + "_tag",
                    Kind("tag", "An RFID tag on a model.")
                        .group("")
                        .model("rfid_tag")
                        .text("id", "that readers read")
                        .shown()
                        .numbers("position", "m", "x y z in the model's frame"))

}  // namespace angen::devices
