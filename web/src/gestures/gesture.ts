/**
 * What a hand is doing, as states: each is told of the pointer and says which state follows. A
 * gesture holds no more than what it began with.
 */
import type { Client } from "../api/client.ts";
import type { Pixel, Point } from "../model/document.ts";
import type { Live } from "../model/live.ts";
import type { Store } from "../model/state.ts";
import type { Viewport } from "../view/viewport.ts";

export interface Pointer {
  /** on the canvas, in pixels */
  at: Pixel;
  /** in the model, snapped where that is wanted */
  place: Point;
  shift: boolean;
  alt: boolean;
  button: number;
  /** whether places are to snap */
  snaps: boolean;
  /** a finger: it hides what it points at */
  coarse: boolean;
  /** the event's own time */
  time: number;
}

export interface Table {
  store: Store;
  live: Live;
  view: Viewport;
  client: Client;
  /** paints soon */
  paint: () => void;
}

export interface Gesture {
  move?(pointer: Pointer): Gesture;
  down?(pointer: Pointer): Gesture;
  up?(pointer: Pointer): Gesture;
  doubled?(pointer: Pointer): Gesture;
  key?(name: string): Gesture | null;
  cancel?(): Gesture;
  readonly cursor?: string;
  /** it finds out itself what snaps to what */
  readonly placesItself?: boolean;
  /** points clicked so far */
  readonly started?: readonly Point[];
  /** what the status line says */
  readonly hint?: string;
}
