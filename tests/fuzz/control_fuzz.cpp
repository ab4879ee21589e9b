// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as an HTTP request to the control API of a daemon that knows every name: it sends one
// answer, which is a valid document.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include <boost/asio/buffer.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>

#include "daemon/api/routes.h"
#include "daemon/device/sensor_record.h"
#include "tests/support/empty_api.h"

namespace {

using namespace scipd;

void require(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "does not hold: " << what << '\n';
    std::abort();
}

void require_sane(const std::optional<sim::Pose>& pose) {
    if (!pose) return;
    const auto& p = pose->translation_m;
    require(std::abs(p.x) <= 1e7 && std::abs(p.y) <= 1e7 && std::abs(p.z) <= 1e7, "within 1e7 m");
    require(std::abs(glm::length(pose->rotation) - 1.0) < 1e-9, "a unit quaternion");
}

class AnyName : public tests::EmptyApi {
  public:
    AnyName() {
        sim::Scan scan{.revolution = 7};
        scan.world_from_sensor = {{}};
        scan.posed_at = {scan.start};
        scan.hits = {{}};
        const auto record = std::make_shared<daemon::ScanRecord>();
        record->cast = std::make_shared<const sim::Scan>(scan);
        record->sent.distance = {1};
        record->sent.intensity = {0};
        record->scene = scene().scene;
        record->backend = std::make_shared<const daemon::BackendChoice>();
        log_.add(record, {});
    }

    [[nodiscard]] std::optional<daemon::SensorLog> log(const std::string&) const override {
        return log_;
    }
    [[nodiscard]] std::optional<sim::TimedPose> robot_pose(const std::string&) const override {
        return sim::TimedPose{};
    }
    sim::Expected<> set_robot_pose(const std::string&, const sim::PoseLine& said) override {
        require_sane(said.pose);
        return {};
    }
    [[nodiscard]] std::optional<sim::TimedPose> model_pose(const std::string&) const override {
        return sim::TimedPose{};
    }
    sim::Expected<> set_model_pose(const std::string&, const sim::PoseLine& said) override {
        require_sane(said.pose);
        return {};
    }
    void edit_scene(daemon::SceneEdit edit, daemon::EditDone done, std::stop_token) override {
        if (const auto* model = std::get_if<daemon::AddModel>(&edit)) {
            require(!model->placement.name.empty(), "a model has a name");
            const int ways = int(!model->sdf.empty()) + int(!model->mesh.empty()) +
                             int(!model->mesh_data.empty()) + int(!model->file.empty());
            require(ways == 1, "a text, a file, a mesh or its bytes");
            require_sane(model->placement.world_from_model);
        }
        done({});
    }

  private:
    daemon::ScanLog log_;
};

void check(const daemon::HttpResponse& response) {
    require(response.status >= 200 && response.status < 600, "a status of HTTP");
    if (response.status == 204) return require(response.body.empty(), "204 has no body");
    // Pages, meshes and metrics.
    if (!response.content_type.ends_with("json"))
        return require(response.status < 400, "a refusal is JSON");
    const auto document = nlohmann::json::parse(response.body, nullptr, false);
    require(!document.is_discarded(), "the body is JSON");
    if (response.status < 400) return;
    require(response.content_type == "application/problem+json", "a refusal is a problem document");
    require(document["status"] == response.status, "that says the status");
    require(!document["detail"].get<std::string>().empty(), "and why");
    require((response.status == 405) == !response.allow.empty(), "405 has what is allowed");
}

std::optional<daemon::HttpRequest> request_in(const std::uint8_t* data, std::size_t size) {
    namespace http = boost::beast::http;
    http::request_parser<http::string_body> parser;
    parser.eager(true);
    boost::system::error_code error;
    parser.put(boost::asio::buffer(data, size), error);
    if (error || !parser.is_header_done()) return std::nullopt;
    const auto& request = parser.get();
    const std::string target{request.target().data(), request.target().size()};
    const auto mark = target.find('?');
    return daemon::HttpRequest{
        .method = {request.method_string().data(), request.method_string().size()},
        .path = target.substr(0, mark),
        .query = mark == target.npos ? "" : target.substr(mark + 1),
        .body = request.body()};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto request = request_in(data, size);
    if (!request) return 0;
    AnyName api;
    int answers = 0;
    daemon::route(api, *request, [&](const daemon::HttpResponse& response) {
        ++answers;
        check(response);
    });
    require(answers == 1, "one answer");
    const auto socket = daemon::open_socket(api, *request);
    if (const auto* refusal = std::get_if<daemon::HttpResponse>(&socket)) check(*refusal);
    return 0;
}
