#pragma once
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace rsphere {

// A hash table that many threads can read and extend at the same time without waiting. Entries are never
// moved, changed or removed. Key needs a member bucket(); Value need not be movable.
template <class Key, class Value>
class InsertOnce {
 public:
  explicit InsertOnce(unsigned logBuckets) : mask_((size_t{1} << logBuckets) - 1), buckets_(mask_ + 1) {}
  ~InsertOnce() {
    for (auto& bucket : buckets_)
      for (Node* node = bucket.load(std::memory_order_relaxed); node;) {
        Node* const next = node->next;
        delete node;
        node = next;
      }
  }

  Value* find(const Key& key) {
    Node* const node = findFrom(buckets_[key.bucket() & mask_].load(std::memory_order_acquire), key);
    return node ? &node->value : nullptr;
  }

  // The value of the key. If there is none, adds the value that make(value) fills in. It is discarded if
  // another thread has added one in the meantime.
  template <class Make>
  Value& findOrAdd(const Key& key, Make make) {
    std::atomic<Node*>& bucket = buckets_[key.bucket() & mask_];
    Node* first = bucket.load(std::memory_order_acquire);
    if (Node* found = findFrom(first, key)) return found->value;
    auto node = std::make_unique<Node>(key);
    make(node->value);
    for (;;) {
      node->next = first;
      if (bucket.compare_exchange_weak(first, node.get(), std::memory_order_release,
                                       std::memory_order_acquire)) {
        size_.fetch_add(1, std::memory_order_relaxed);
        return node.release()->value;
      }
      if (Node* found = findFrom(first, key)) return found->value;
    }
  }

  size_t size() const { return size_.load(std::memory_order_relaxed); }

 private:
  // The value is stored next to its key, since most of the time of a look-up is spent waiting for memory.
  struct Node {
    explicit Node(const Key& k) : key(k) {}
    Key key;
    Node* next = nullptr;
    Value value{};
  };
  static Node* findFrom(Node* node, const Key& key) {
    while (node && !(node->key == key)) node = node->next;
    return node;
  }

  size_t mask_;
  std::vector<std::atomic<Node*>> buckets_;
  std::atomic<size_t> size_{0};
};

}  // namespace rsphere
