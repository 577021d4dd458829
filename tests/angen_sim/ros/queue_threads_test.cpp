#include "ros/queue_threads.h"

#include <gtest/gtest.h>
#include <ros/callback_queue_interface.h>

#include <boost/make_shared.hpp>
#include <future>

namespace angen::node {
namespace {

class Call : public ros::CallbackInterface {
 public:
  CallResult call() override {
    called_.set_value(std::this_thread::get_id());
    return Success;
  }
  std::future<std::thread::id> called() { return called_.get_future(); }

 private:
  std::promise<std::thread::id> called_;
};

TEST(QueueThreads, CallWhatComesUntilTheyAreStopped) {
  ros::CallbackQueue queue;
  QueueThreads threads(queue, 2);
  const auto before = boost::make_shared<Call>();
  std::future<std::thread::id> first = before->called();
  threads.start();
  queue.addCallback(before);
  ASSERT_EQ(first.wait_for(std::chrono::seconds(60)), std::future_status::ready);
  EXPECT_NE(first.get(), std::this_thread::get_id());
  threads.stop();
  queue.addCallback(boost::make_shared<Call>());
  EXPECT_TRUE(queue.isEmpty());
}

}  // namespace
}  // namespace angen::node
