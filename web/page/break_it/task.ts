// What the two tasks of the lesson share.
import type {Vector} from "../core";
import type {FaceView} from "../face_view";
import type {State} from "../lesson";

export interface Place {
  controls: HTMLElement; // above the pictures
  text: HTMLElement;
  view: FaceView;
}

export interface Task {
  place: Place;
  state: State;
  vectors: Map<string, Vector>; // by name
}
