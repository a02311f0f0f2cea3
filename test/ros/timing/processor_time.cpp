#include "processor_time.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

namespace concave_distance {

int processOf(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", request, response, uri, false) ||
      !ros::network::splitURI(static_cast<std::string>(uri), host, port)) {
    return 0;
  }
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue name;
  name[0] = ros::this_node::getName();
  return client.execute("getPid", name, response) ? static_cast<int>(response[2]) : 0;
}

double processSeconds(int process) {
  std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(stream, text);
  // After the name, which may hold blanks: state, ten more fields, then utime and stime (proc(5)).
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
  std::string skipped;
  for (int i = 0; i < 11; ++i) {
    fields >> skipped;
  }
  double user = std::nan("");
  double system = std::nan("");
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

MachineSeconds machineSeconds() {
  std::ifstream stream("/proc/stat");
  std::string name;
  std::array<double, 8> ticks{};  // user nice system idle iowait irq softirq steal
  stream >> name;
  for (double& tick : ticks) {
    stream >> tick;
  }
  const auto per_second = static_cast<double>(sysconf(_SC_CLK_TCK));
  return {ticks[3] / per_second, ticks[7] / per_second};
}

}  // namespace concave_distance
