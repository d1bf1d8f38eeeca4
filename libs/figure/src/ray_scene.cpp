#include "ray_scene.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace ostia::figure {
namespace {

void on_embree_error(void* failed, RTCError, const char*) {
  *static_cast<bool*>(failed) = true;
}

struct Vertex4 {
  float x, y, z, r;
};

RTCRay embree_ray(const Ray& ray, double near_mm, double far_mm) {
  RTCRay result{};
  result.org_x = static_cast<float>(ray.origin.x());
  result.org_y = static_cast<float>(ray.origin.y());
  result.org_z = static_cast<float>(ray.origin.z());
  result.dir_x = static_cast<float>(ray.direction.x());
  result.dir_y = static_cast<float>(ray.direction.y());
  result.dir_z = static_cast<float>(ray.direction.z());
  result.tnear = static_cast<float>(near_mm);
  result.tfar = static_cast<float>(far_mm);
  result.mask = 0xFFFFFFFFU;
  return result;
}

}  // namespace

struct RayScene::Impl {
  struct Part {
    RTCScene scene = nullptr;
    std::vector<std::pair<bool, std::size_t>> actor_of;  // by geometry id: whether a tube, and its index
  };

  bool failed = false;
  RTCDevice device = nullptr;
  RTCDevice unlimited = nullptr;
  Part opaque, transparent;
  Vec3 centre = Vec3::Zero();
  double diagonal = 0.0;
  std::vector<std::vector<std::array<Eigen::Vector3f, 3>>> normals;  // by mesh; empty when flat

  ~Impl() {
    if (opaque.scene != nullptr) rtcReleaseScene(opaque.scene);
    if (transparent.scene != nullptr) rtcReleaseScene(transparent.scene);
    if (device != nullptr) rtcReleaseDevice(device);
    if (unlimited != nullptr) rtcReleaseDevice(unlimited);
  }

  void check() const {
    if (failed) throw ResourceError("the scene could not be prepared for ray casting: not enough memory");
  }

  void attach(Part& part, RTCGeometry geometry, bool tube, std::size_t actor) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(part.scene, geometry);
    rtcReleaseGeometry(geometry);
    part.actor_of.emplace_back(tube, actor);
  }

  template <class T>
  T* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
    check();
    return static_cast<T*>(data);
  }

  void add(const MeshActor& actor, std::size_t index) {
    if (actor.mesh.triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = buffer<std::array<float, 3>>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                                actor.mesh.points.size());
    for (std::size_t i = 0; i < actor.mesh.points.size(); ++i) {
      const Eigen::Vector3f p = (actor.mesh.points[i] - centre).cast<float>();
      points[i] = {p.x(), p.y(), p.z()};
    }
    auto* triangles = buffer<std::array<std::uint32_t, 3>>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                           actor.mesh.triangles.size());
    for (std::size_t i = 0; i < actor.mesh.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        triangles[i][k] = static_cast<std::uint32_t>(actor.mesh.triangles[i][k]);
    }
    attach(actor.color.a < 1.0 ? transparent : opaque, geometry, false, index);
  }

  void add(const TubeActor& tube, std::size_t index) {
    const bool ball = tube.points.size() == 1;
    RTCGeometry geometry =
        rtcNewGeometry(device, ball ? RTC_GEOMETRY_TYPE_SPHERE_POINT : RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    auto* points = buffer<Vertex4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, tube.points.size());
    for (std::size_t i = 0; i < tube.points.size(); ++i) {
      const Eigen::Vector3f p = (tube.points[i] - centre).cast<float>();
      const double radius = tube.radius_mm[tube.radius_mm.size() > 1 ? i : 0];
      points[i] = {p.x(), p.y(), p.z(), static_cast<float>(radius)};
    }
    if (!ball) {
      const std::size_t pieces = tube.points.size() - 1;
      auto* starts = buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, pieces);
      auto* flags = buffer<std::uint8_t>(geometry, RTC_BUFFER_TYPE_FLAGS, RTC_FORMAT_UCHAR, pieces);
      for (std::size_t i = 0; i < pieces; ++i) {
        starts[i] = static_cast<std::uint32_t>(i);
        flags[i] = static_cast<std::uint8_t>((i > 0 ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                             (i + 1 < pieces ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
      }
    }
    attach(tube.color.a < 1.0 ? transparent : opaque, geometry, true, index);
  }

  void commit(Part& part) {
    rtcSetSceneFlags(part.scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips between two triangles
    rtcCommitScene(part.scene);
    check();
  }
};

RayScene::RayScene(const Scene& scene, const Vec3& centre) : impl_(std::make_unique<Impl>()) {
  impl_->normals.resize(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const MeshActor& actor = scene.meshes[i];
    if (actor.shading == Shading::smooth) impl_->normals[i] = corner_normals(actor.mesh, actor.crease_deg);
  }
  // Built by one thread, so that ties between triangles fall the same way every time.
  impl_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (impl_->device == nullptr) throw ResourceError("the ray caster could not be started: not enough memory");
  rtcSetDeviceErrorFunction(impl_->device, on_embree_error, &impl_->failed);
  impl_->centre = centre;
  impl_->opaque.scene = rtcNewScene(impl_->device);
  impl_->transparent.scene = rtcNewScene(impl_->device);
  geometry::Box3 box;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const MeshActor& actor = scene.meshes[i];
    impl_->add(actor, i);
    for (const Vec3& p : actor.mesh.points) box.extend(p);
  }
  for (std::size_t i = 0; i < scene.tubes.size(); ++i) {
    impl_->add(scene.tubes[i], i);
    for (const Vec3& p : scene.tubes[i].points) box.extend(p);
    box.extend(Vec3(scene.tubes[i].points.front() + Vec3::Constant(scene.tubes[i].radius_mm.front())));
  }
  impl_->commit(impl_->opaque);
  impl_->commit(impl_->transparent);
  // A device's limit holds for all of TBB, and the largest of all devices' limits counts: a second one lifts
  // it again.
  impl_->unlimited = rtcNewDevice("set_affinity=0");
  impl_->diagonal = box.isEmpty() ? 0.0 : box.diagonal().norm();
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::first_hit(Part part, const Ray& ray, double near_mm, double far_mm) const {
  const Impl::Part& where = part == Part::opaque ? impl_->opaque : impl_->transparent;
  alignas(16) RTCRayHit query{};
  query.ray = embree_ray(ray, near_mm, far_mm);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(where.scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit;
  hit.t = static_cast<double>(query.ray.tfar);
  std::tie(hit.tube, hit.actor) = where.actor_of[query.hit.geomID];
  hit.triangle = query.hit.primID;
  const double u = static_cast<double>(query.hit.u);
  const double v = static_cast<double>(query.hit.v);
  hit.barycentric = Vec3(1.0 - u - v, u, v);
  hit.normal = Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).cast<double>().normalized();
  return hit;
}

bool RayScene::occluded(const Ray& ray, double near_mm, double far_mm) const {
  alignas(16) RTCRay query = embree_ray(ray, near_mm, far_mm);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->opaque.scene, &context, &query);
  return query.tfar < 0.0F;
}

bool RayScene::has_transparent() const {
  return !impl_->transparent.actor_of.empty();
}
const Vec3& RayScene::centre() const {
  return impl_->centre;
}
double RayScene::diagonal_mm() const {
  return impl_->diagonal;
}

Vec3 RayScene::shading_normal(const Hit& hit) const {
  if (hit.tube || impl_->normals[hit.actor].empty()) return hit.normal;
  const auto& corners = impl_->normals[hit.actor][hit.triangle];
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    sum += hit.barycentric[static_cast<Eigen::Index>(k)] * corners[k].cast<double>();
  return sum.norm() > 1e-9 ? Vec3(sum.normalized()) : hit.normal;
}

std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const geometry::TriMesh& mesh, double crease_deg) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Vec3> areas(count);  // twice the area along the normal
  std::vector<std::int32_t> first(mesh.points.size() + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
    areas[i] = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                   .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
    for (const std::int32_t corner : t) ++first[static_cast<std::size_t>(corner) + 1];
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::int32_t> around(3 * count);
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::int32_t corner : mesh.triangles[i]) {
      around[static_cast<std::size_t>(next[static_cast<std::size_t>(corner)]++)] =
          static_cast<std::int32_t>(i);
    }
  }
  const double least_cosine = std::cos(crease_deg * std::numbers::pi / 180.0);
  std::vector<std::array<Eigen::Vector3f, 3>> result(count);
  core::parallel_for(count, 4096, [&](std::size_t i) {
    const double own = areas[i].norm();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(mesh.triangles[i][k]);
      Vec3 sum = Vec3::Zero();
      for (std::int32_t at = first[vertex]; at < first[vertex + 1]; ++at) {
        const Vec3& other = areas[static_cast<std::size_t>(around[static_cast<std::size_t>(at)])];
        if (other.dot(areas[i]) >= least_cosine * own * other.norm()) sum += other;
      }
      const double norm = sum.norm();
      result[i][k] = (norm > 0.0 ? Vec3(sum / norm) : Vec3(Vec3::Zero())).cast<float>();
    }
  });
  return result;
}

}  // namespace ostia::figure
