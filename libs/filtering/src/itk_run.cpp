#include "itk_run.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <itkCommand.h>
#include <itkMultiThreaderBase.h>
#include <itkObjectFactoryBase.h>
#include <itkVersion.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <new>
#include <typeinfo>

namespace ostia::filtering::detail {
namespace {

// Sums that ITK keeps by work unit are added in their order: their number decides on the last bits, the
// threads that do them do not. Many, so that a cancel does not wait for long.
constexpr unsigned work_units = 64;
constexpr std::size_t most_pieces = 1024;

/// The job of the calling thread while it is in `in_our_threads`.
thread_local const core::TaskContext* current_task = nullptr;

/// ITK's loops on core's threads.
class SharedThreads : public itk::MultiThreaderBase {
 public:
  using Self = SharedThreads;
  using Superclass = itk::MultiThreaderBase;
  using Pointer = itk::SmartPointer<Self>;
  static Pointer New() {
    Pointer made = new Self;
    made->UnRegister();  // it is counted from the first on
    return made;
  }
  using Superclass::ParallelizeImageRegion;

  void SetSingleMethod(itk::ThreadFunctionType method, void* data) override {
    m_SingleMethod = method;
    m_SingleData = data;
  }

  void SingleMethodExecute() override {
    const core::TaskContext& task = watched();
    core::parallel_for(m_NumberOfWorkUnits, 1, [&](std::size_t unit) {
      task.throw_if_cancelled();
      WorkUnitInfo info{};
      info.WorkUnitID = static_cast<itk::ThreadIdType>(unit);
      info.NumberOfWorkUnits = m_NumberOfWorkUnits;
      info.UserData = m_SingleData;
      info.ThreadFunction = m_SingleMethod;
      m_SingleMethod(&info);
    });
  }

  void ParallelizeArray(itk::SizeValueType first, itk::SizeValueType behind, ArrayThreadingFunctorType work,
                        itk::ProcessObject* filter) override {
    if (first >= behind) return;
    in_pieces(behind - first, filter, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) work(first + i);
    });
  }

  void ParallelizeImageRegion(unsigned int dimension, const itk::IndexValueType index[],
                              const itk::SizeValueType size[], ThreadingFunctorType work,
                              itk::ProcessObject* filter) override {
    unsigned slowest = dimension - 1;
    while (slowest > 0 && size[slowest] == 1) --slowest;
    in_pieces(size[slowest], filter, [&](std::size_t from, std::size_t to) {
      std::vector<itk::IndexValueType> at(index, index + dimension);
      std::vector<itk::SizeValueType> part(size, size + dimension);
      at[slowest] += static_cast<itk::IndexValueType>(from);
      part[slowest] = to - from;
      work(at.data(), part.data());
    });
  }

 protected:
  SharedThreads() {
    m_NumberOfWorkUnits = work_units;
    m_MaximumNumberOfThreads = work_units;
  }

 private:
  static const core::TaskContext& watched() { return current_task ? *current_task : core::no_task(); }

  template <class Work>
  void in_pieces(std::size_t count, itk::ProcessObject* filter, const Work& work) const {
    const std::size_t grain = (count + most_pieces - 1) / most_pieces;
    const core::TaskContext& task = watched();
    const bool tell = filter != nullptr && GetUpdateProgress();
    core::parallel_chunks(count, grain, [&](std::size_t from, std::size_t to) {
      task.throw_if_cancelled();
      work(from, to);
      if (tell) filter->IncrementProgress(static_cast<float>(to - from) / static_cast<float>(count));
    });
  }
};

/// Gives filters that are made within `in_our_threads` their threads, and no others.
class ThreadsFactory : public itk::ObjectFactoryBase {
 public:
  using Self = ThreadsFactory;
  using Pointer = itk::SmartPointer<Self>;
  static Pointer New() {
    Pointer made = new Self;
    made->UnRegister();
    return made;
  }
  const char* GetITKSourceVersion() const override { return ITK_SOURCE_VERSION; }
  const char* GetDescription() const override { return "Ostia's threads"; }

 protected:
  itk::LightObject::Pointer CreateObject(const char* name) override {
    if (current_task == nullptr || std::strcmp(name, typeid(itk::MultiThreaderBase).name()) != 0)
      return nullptr;
    return itk::LightObject::Pointer(SharedThreads::New());
  }
};

/// While it lives, this thread's filters work for a task, and ITK's warnings, which go to the terminal, are
/// off.
class InOurThreads {
 public:
  explicit InOurThreads(const core::TaskContext& task) : warned_(itk::Object::GetGlobalWarningDisplay()) {
    static std::once_flag once;
    std::call_once(once, [] { itk::ObjectFactoryBase::RegisterFactory(ThreadsFactory::New()); });
    current_task = &task;
    itk::Object::GlobalWarningDisplayOff();
  }
  ~InOurThreads() {
    current_task = nullptr;
    itk::Object::SetGlobalWarningDisplay(warned_);
  }
  InOurThreads(const InOurThreads&) = delete;
  InOurThreads& operator=(const InOurThreads&) = delete;

 private:
  bool warned_;
};

}  // namespace

void set_grid(itk::ImageBase<3>& image, const imaging::Geometry& grid) {
  itk::ImageBase<3>::SizeType size;
  itk::ImageBase<3>::SpacingType spacing;
  itk::ImageBase<3>::PointType origin;
  itk::ImageBase<3>::DirectionType direction;
  for (unsigned a = 0; a < 3; ++a) {
    size[a] = static_cast<itk::SizeValueType>(grid.size[a]);
    spacing[a] = grid.spacing[a];
    origin[a] = grid.origin[a];
    for (unsigned b = 0; b < 3; ++b) direction[a][b] = grid.direction(a, b);
  }
  image.SetRegions(size);
  image.SetSpacing(spacing);
  image.SetOrigin(origin);
  image.SetDirection(direction);
}

void update(itk::ProcessObject& filter, const core::TaskContext& task) {
  auto watch = itk::FunctionCommand::New();
  watch->SetCallback([&](const itk::EventObject&) {
    task.set_progress(filter.GetProgress());
    if (task.cancelled()) filter.AbortGenerateDataOn();
  });
  const auto progress = filter.AddObserver(itk::ProgressEvent(), watch);
  const auto iteration = filter.AddObserver(itk::IterationEvent(), watch);
  filter.UpdateLargestPossibleRegion();
  filter.RemoveObserver(progress);
  filter.RemoveObserver(iteration);
  task.set_progress(1.0);
}

Image in_our_threads(const std::string& name, const core::TaskContext& task,
                     const std::function<Image()>& step) {
  const auto no_memory = [&] { return ResourceError(name + ": not enough memory"); };
  try {
    const InOurThreads scope(task);
    Image image = step();
    task.throw_if_cancelled();
    return image;
  } catch (const itk::ProcessAborted&) {
    throw Cancelled();
  } catch (const itk::MemoryAllocationError&) {
    throw no_memory();
  } catch (const std::bad_alloc&) {
    throw no_memory();
  } catch (const itk::ExceptionObject& error) {
    task.throw_if_cancelled();
    throw NumericalError(name + ": ITK says: " + error.GetDescription());
  }
}

}  // namespace ostia::filtering::detail
