import { describe, expect, it } from "vitest";
import { eventsOf, takeToken } from "../../src/api/server.ts";

function inPieces(text: string, size: number): ReadableStream<Uint8Array> {
  const bytes = new TextEncoder().encode(text);
  let at = 0;
  return new ReadableStream({
    pull(controller) {
      if (at >= bytes.length) return controller.close();
      controller.enqueue(bytes.slice(at, at + size));
      at += size;
    },
  });
}

describe("events", () => {
  it("come whole however they are cut", async () => {
    const text = 'event: progress\ndata: {"doing":"\u00e4"}\n\nevent: answer\ndata: {"ok":true}\n\n';
    for (const size of [1, 2, 3, 7, 1000]) {
      const seen = [];
      for await (const event of eventsOf(inPieces(text, size))) seen.push(event);
      expect(seen).toEqual([
        { name: "progress", data: '{"doing":"\u00e4"}' },
        { name: "answer", data: '{"ok":true}' },
      ]);
    }
  });
});

describe("token", () => {
  it("is taken from the address and then from the tab", () => {
    const kept = new Map<string, string>();
    const storage = {
      getItem: (k: string) => kept.get(k) ?? null,
      setItem: (k: string, v: string) => void kept.set(k, v),
    } as unknown as Storage;
    expect(takeToken({ hash: "#token=abc" } as Location, storage)).toBe("abc");
    expect(takeToken({ hash: "" } as Location, storage)).toBe("abc");
  });
});
