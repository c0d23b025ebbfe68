(()=>{var{find:J,make:$}=document.currentScript.shared;var{CanvasPen:K}=document.currentScript.shared;var{HALO_WIDTH:Z,SERIF:A,STYLES:Q,colours:L}=document.currentScript.shared;var{writeNumber:M}=document.currentScript.shared;var{LIGHT:X,Pen:ee,cornersOf:te,textParts:ne,traceDisc:se}=document.currentScript.shared;var{counted:x}=document.currentScript.shared;var{along:ae}=document.currentScript.shared;var{tableLonlat:oe}=document.currentScript.shared;var{lonLatOf:R}=document.currentScript.shared;var{asCount:z}=document.currentScript.shared;var{Kept:F,filled:H,run:ie}=document.currentScript.shared;var{poleSeen:re}=document.currentScript.shared;var Ie=3,je=3,Ce=class extends ee{#e=[];#t=[];text(e){let[t,n]=[g(this.width),g(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${t}" height="${n}" viewBox="0 0 ${t} ${n}">`,`<title>${W(e)}</title>`,...this.#e.length>0?[`<defs>${this.#e.join("")}</defs>`]:[],`<rect width="${t}" height="${n}" ${v("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${A}'>`,...this.#t].join(`
`)}
</g>
</svg>
`}path(e,t,n,s){let a=le(t);if(a==="")return;let o=[];s.fill!==void 0&&o.push(v("fill",n??this.colours[s.fill],s.fillOpacity)),s.stroke!==void 0&&o.push(this.#n(s,n)),this.#t.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}within({opacity:e=1,region:t,corner:n},s){let a=`clip-${this.#e.length}`;t&&this.#e.push(`<clipPath id="${a}"><path d="${le(t)}"/></clipPath>`);let o=t?` clip-path="url(#${a})"`:"",r=e<1?` opacity="${e}"`:"",c=n?` transform="translate(${n.map(g).join(" ")})"`:"";this.#t.push(`<g${o}${r}${c}>`),s(),this.#t.push("</g>")}discs(e,t,n){let{radius:s,fill:a,rim:o,rimWidth:r,opacity:c}=t,i=g(s-r/2),l=`dots-${this.#e.length}`,d=[];for(let p=0;p<n.length;p+=2)d.push(`<circle cx="${g(n[p])}" cy="${g(n[p+1])}" r="${i}"/>`);this.#e.push(`<g id="${l}">${d.join("")}</g>`);let h=`fill="none" ${v("stroke",this.colours[o],c)} stroke-width="${g(2*r)}"`;this.#t.push(`<use class="${e}-rim" href="#${l}" ${h}/>`),this.#t.push(`<use class="${e}" href="#${l}" ${v("fill",this.colours[a],c)}/>`)}spots(e,t){let n=this.#n(Q["spot-line"]);t.forEach((s,a)=>{let[o,r,c]=[e[3*a],e[3*a+1],e[3*a+2]].map(g);this.#t.push(`<circle class="spot" cx="${o}" cy="${r}" r="${c}" ${v("fill",s)} ${n}/>`)})}label(e,t,n,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ne(e,s.italic??!1).map(i=>i.italic?`<tspan font-style="italic">${W(i.text)}</tspan>`:W(i.text)).join(""),r=`paint-order="stroke" ${v("stroke",this.inkOf(s.halo))} stroke-width="${Z}"`,c=`x="${g(t)}" y="${g(n)}" font-size="${s.size}" text-anchor="${a}"`;this.#t.push(`<text ${c} ${v("fill",this.inkOf(s.ink))} ${r}>${o}</text>`)}picture(e,t,n,s,a){if(e instanceof HTMLImageElement){let c=decodeURIComponent(e.src.slice(e.src.indexOf(",")+1));return this.within({corner:[t,n]},()=>this.#t.push(c))}let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let r=`x="${g(t)}" y="${g(n)}" width="${g(s)}" height="${g(a)}"`;this.#t.push(`<image ${r} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,t=this.colours[e.stroke??"ink"]){let n=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`,s=g((e.width??1)*this.weight);return`${v("stroke",t,e.strokeOpacity)} stroke-width="${s}"${n}`}fillDisc({x:e,y:t,r:n},s){let a=typeof s=="string"?v("fill",s):`fill="url(#${s.id})"`;if(this.#t.push(`<circle ${a} cx="${g(e)}" cy="${g(t)}" r="${g(n)}"/>`),typeof s=="string")return;let o=s.stops.map(([i,l])=>`<stop offset="${i}" ${v("stop-color",l,1,"stop-opacity")}/>`),r=Object.entries(X).map(([i,l])=>`${i}="${g((l+(i==="r"?0:1))/2)}"`),c=`<radialGradient id="${s.id}" ${r.join(" ")}>${o.join("")}</radialGradient>`;this.#e.includes(c)||this.#e.push(c)}};function le(e){let t="";return e({moveTo:(n,s)=>t+=`M${g(n)} ${g(s)}`,lineTo:(n,s)=>t+=`L${g(n)} ${g(s)}`,ellipse(n,s,a,o,r,c,i,l=!1){let[d,h]=[Math.cos(r),Math.sin(r)],p=u=>{let[b,y]=[a*Math.cos(u),o*Math.sin(u)];return[n+b*d-y*h,s+b*h+y*d]};t===""?this.moveTo(...p(c)):this.lineTo(...p(c));let m=Math.ceil(Math.abs(i-c)/je),f=`${g(a)} ${g(o)} ${g(r*180/Math.PI)} 0 ${l?0:1}`;for(let u=1;u<=m;++u){let[b,y]=p(c+(i-c)*u/m);t+=`A${f} ${g(b)} ${g(y)}`}},closePath:()=>t+="Z"}),t}function g(e){return M(e,Ie)}function v(e,t,n=1,s=`${e}-opacity`){let[a,o,r,c=1]=(t.match(/[\d.]+/g)??[]).map(Number),i=c*n,l=i===1?"":` ${s}="${g(i)}"`;return`${e}="rgb(${a}, ${o}, ${r})"${l}`}function W(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var S={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},P=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,Fe=new Set(S.missing),E=e=>Fe.has(e.trim().toLowerCase()),He=new RegExp(`\\0|[^\\x00-\\x7f${S.western}]|[^\\x00-\\x7f]{3}`),We="぀";function U(e,t=!1){let[n,s]=["lon","lat"].map(a=>{let[o,r]=[S[a],S[`unsure_${a}`]],l=[d=>o.includes(d),(d,h)=>o.some(p=>h.includes(p)||p>We&&d.includes(p)),(d,h)=>h.length>0&&h.every(p=>r.includes(p))].slice(0,t?2:3).map(d=>e.filter(h=>d(h.trim().toLowerCase(),Ue(h)))).find(d=>d.length>0);return l?.length===1?l[0]:null});return n===null||s===null||n===s?null:[n,s]}function Ue(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(n=>n!==""&&!S.beside.includes(n))}var Ge=new RegExp(`^(?:${S.lettered})$`,"iu"),Ve=new RegExp(`[${S.printed}${S.unseen}]`,"gu");function T(e){return e.replace(Ve,n=>S.typed[S.printed.indexOf(n)]??"").trim().replace(/\s+/g," ")}var Be=new Map(Object.entries({...S.compass,O:"O"}).flatMap(([e,t])=>[e,...t.toLowerCase().split(" ")].map(n=>[n,e]))),me=e=>Be.get(e.length>1?e.toLowerCase():e),ce="[0-9]+(?:[.,][0-9]*)?",qe=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${ce})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${ce})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function Ye(e){let t=e.length>200?null:qe.exec(T(e))?.groups;if(!t)return null;let{before:n,after:s,sign:a}=t,o=[t.degrees,t.minutes,t.seconds].filter(h=>h!==void 0),r=o.map(h=>h.replace(",",".").replace(/\.$/,"")),c=n??s?me(n??s):"",i=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h));return c===void 0||n&&s||c&&a||!i||r.slice(1).some(h=>Number(h)>=60)?null:{degrees:(c==="W"||c==="S"||a==="-"?-1:1)*(c==="O"?NaN:Je(r)),point:c}}function Je(e){if(e.length===1)return Number(e[0]);let t=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((n,s)=>60*n+Math.round(Number(s)*t),0)/(t*60**(e.length-1))}var be=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Ke=/^[-+]?0[0-9]/,Ze={longitude:"EWO",latitude:"NS"};function Qe(e){let[t,n]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return t.length===1&&n.length===1?[t[0],n[0]]:e.length===2?[e[0],e[1]]:null}function Xe(e,t,n){let s=t==="plane"?we(e.columns):"",a=i=>_e(i,s)?NaN:ve(i),[o,r]=n.map((i,l)=>t==="lonlat"?tt(e,i,["longitude","latitude"][l]):xe(e,i,e.columns.get(i),"a number without a mark between thousands",a)),c=Float64Array.from({length:2*o.length},(i,l)=>(l%2===0?o:r)[l>>1]);return t==="lonlat"?ye(c,e.wrong):c}function ye(e,t){for(let n=0;n<e.length/2;++n){let[s,a]=e.subarray(2*n,2*n+2);t.has(n)||Math.abs(a)<=90&&Math.abs(s)<=360||t.set(n,`longitude ${s}, latitude ${a} is not on Earth; are they swapped, or not in degrees?`)}return e}function et(e,t){let n=we(e),s=c=>P.test(c)&&!Ke.test(c)&&!_e(c,n),a=c=>E(c)||s(c.trim()),o=[...e].filter(([c,i])=>!t.has(c)&&i.every(a)&&!i.every(E)),r=c=>E(c)?NaN:Se(c.trim());return new Map(o.map(([c,i])=>[c,Float64Array.from(i,r)]))}function we(e){let n=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>P.test(s)&&!be.test(s));return[...new Set(n.map($e))].join("")||"."}var $e=e=>e.includes(",")?",":".",_e=(e,t)=>be.test(e)&&$e(e)!==t,Se=e=>Number(e.replace(",","."));function tt(e,t,n){let s=Ze[n],a=`degrees with a sign, ${s[0]} or ${s[1]}`;return xe(e,n,nt(e,t,s),a,o=>{let r=P.test(o)?null:Ye(o);return r===null?ve(o):s.includes(r.point)?r.degrees:NaN})}function nt({columns:e},t,n){let[s,a]=[e.get(t),[...e.keys()]],o=a[a.indexOf(t)+1]??"";if(!Ge.test(o))return s;let r=e.get(o).map(l=>E(T(l))?"":T(l)),c=r.filter(Boolean).map(l=>me(l)??"?");return!(c.length>0&&c.every(l=>n.includes(l)))||s.some(l=>T(l).includes("-")&&!E(l))?s:s.map((l,d)=>E(l)?"":`${l} ${r[d]}`.trim())}var ve=e=>P.test(e)?Se(e):NaN;function xe({wrong:e},t,n,s,a){return Float64Array.from(n,(o,r)=>{let c=o.trim(),i=a(c);return Number.isFinite(i)?i:(e.has(r)||e.set(r,`the ${t} is ${E(c)?"missing":`'${c}', not ${s}`}`),NaN)})}var st=[",",";","	","|"],at=50,ot=20,ke=/\r\n|\n|\r/,it=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function rt(e){let t=e.replace(it,""),n=lt(t),a=(n===null?t.split(ke).map(Ee):[...ct(t,n)]).filter(f=>f.some(u=>u.trim()!==""));if(a.length===0)throw new w("the table is empty");let{names:o,data:r}=dt(a),c=r.length<a.length,i=o.find((f,u)=>f!==""&&o.indexOf(f)!==u);if(i!==void 0)throw new w(`there are several columns with the name '${i}'`);let l=o.map(()=>[]),d=new Map,h=o.reduce((f,u,b)=>u===""?f:b+1,0);r.forEach((f,u)=>{f.length>=h&&f.slice(o.length).every(y=>y==="")||d.set(u,`it has ${f.length} in place of ${o.length} fields`),l.forEach((y,O)=>y.push(f[O]??""))});let m=o.map((f,u)=>[f||`column_${u+1}`,l[u]]).filter(([,f],u)=>o[u]!==""||f.some(b=>b!==""));return{columns:new Map(m),count:r.length,isHeaded:c,wrong:d}}function lt(e){let t=e.split(ke,at).filter(i=>i.trim()!==""),n=t.map(i=>i.replace(/"[^"]*"/g,"")),a=st.map(i=>({mark:i,widths:n.map(l=>l.split(i).length)})).filter(({widths:i})=>Math.max(0,...i)>1),o=a.filter(({widths:i})=>new Set(i).size===1),r=[...new Set(t.map(i=>Ee(i).length))];if(a.length===0||o.length===0&&r.length===1&&r[0]>1)return null;let c=({widths:i})=>Math.max(...i.map(l=>l>1?1e6*i.filter(d=>d===l).length+l:0));return(o.length>0?o:a).reduce((i,l)=>c(l)>c(i)?l:i).mark}var Ee=e=>e.trim().split(/\s+/);function*ct(e,t){let n=`[^"\\${t}\\r\\n][^\\${t}\\r\\n]*`,s=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${n})?)(\\${t}|\\r\\n|\\n|\\r|$)`,"y"),a=[];for(;s.lastIndex<e.length;){let o=s.lastIndex,r=s.exec(e);if(r===null)throw new w(`in ${e.slice(o,o+20)}… a quotation mark does not end a field; write it twice`);a.push(r[1]?.replaceAll('""','"')??r[2]??""),r[3]!==t&&(yield a,a=[])}a.length>0&&(yield[...a,""])}function dt(e){let t=e.slice(0,ot).map(l=>l.map(d=>d.trim())),n=t.map(l=>l.filter(d=>d!=="")),s=l=>P.test(l),a=n.findIndex((l,d)=>U(l)!==null&&(d===0||!l.some(s))),o=n.findIndex(l=>l.length>1),r=Math.max(0,a>=0?a:o);return a<0&&2*n[r].filter(s).length>n[r].length?{names:t[r].length===2?["lon","lat"]:t[r].map((l,d)=>`column_${d+1}`),data:e.slice(r)}:{names:t[r],data:e.slice(r+1)}}function ht(e,t,n=null,s=new Map){let a=i=>typeof i=="string"?/[",\r\n]/.test(i)?`"${i.replaceAll('"','""')}"`:i:Object.is(i,-0)?"-0.0":Number.isFinite(i)?String(i):"",o=new Map([...n?[["name",n]]:[],...s]),r=[...e,...o.keys()],c=Array.from({length:t.length/2},(i,l)=>[t[2*l],t[2*l+1],...Array.from(o.values(),d=>d[l])]);return[r,...c].map(i=>`${i.map(a).join()}
`).join("")}var w=class extends Error{columns;constructor(e,t=[]){super(e),this.columns=t}};function pt(e){let t=ut(e),n=k(t,"type")==="Feature"?[t]:k(t,"features");if(!Array.isArray(n))throw new w("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=n.map((l,d)=>{let h=gt(l);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=ye(Float64Array.from(a.flat()),s),r=n.map(l=>k(l,"properties")),c=new Set(r.flatMap(l=>Object.keys(l??{}))),i=new Map([...c].map(l=>[l,r.map(d=>ft(k(d,l)))]));return{places:o,table:{columns:i,count:n.length,isHeaded:!0,wrong:s}}}function ft(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function k(e,t){return typeof e=="object"&&e!==null?e[t]:void 0}function ut(e){try{return JSON.parse(e)}catch(t){throw new w(`the file is not JSON: ${t instanceof Error?t.message:String(t)}`)}}function gt(e){let t=k(e,"geometry"),[n,s]=[k(t,"type"),k(t,"coordinates")],a=n==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(n!=="Point"&&!a)return`a Point is needed, not ${typeof n=="string"?n:"no geometry"}`;let o=a?s[0]:s,r=Array.isArray(o)?o.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}var de=1e6;async function mt(e,t,n,s){let a=$t(await wt(t),e),o=/^\s*[{[]/.test(a);if(o&&n==="plane")return{room:"globe"};let r=o?pt(a):yt(a,n,s);if("room"in r)return r;let{places:c,table:i,axes:l=[]}=r,{count:d,wrong:h}=i;if(d===0)throw new w("there are no points");if(d>de){let b=`the page takes up to ${x(de)}; for more there is the Python library`;throw new w(`there are ${x(d)} points; ${b}`)}let p=h.size===0?"":bt(i);if(h.size===d)throw new w(p);let m=(b,y)=>!h.has(y),f=new Map([...i.columns].map(([b,y])=>[b,y.filter(m)])),u=[...f.keys()].find(b=>b.trim().toLowerCase()==="name")??"";return{file:e,places:c.filter((b,y)=>m(0,y>>1)),names:f.get(u)??null,values:et(f,new Set([...l,u])),leftOut:h.size,wrong:p}}function bt({count:e,wrong:t}){let n=[...t.keys()].reduce((a,o)=>Math.min(a,o));return`${t.size===e?"No row can":`${x(t.size)} of ${x(e)} rows cannot`} be placed. Row ${x(n+1)}: ${t.get(n)}`}function yt(e,t,n){let s=rt(e),a=[...s.columns.keys()],o=s.isHeaded?U(a,!0):null,r=n??(t==="lonlat"?U(a):Qe(a));if(r===null&&o!==null)return{room:"globe"};if(r===null)throw new w("the table has no two columns of coordinates",a);let c=Xe(s,t,r),i=[...s.wrong.keys()].filter(l=>Number.isFinite(c[2*l]+c[2*l+1]));return t==="lonlat"&&o===null&&2*i.length>s.count?{room:"lift",columns:r}:{places:c,table:s,axes:r}}async function wt(e){if(!(e[0]===31&&e[1]===139))return e;try{let t=new Blob([e.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(t).arrayBuffer())}catch{throw new w("the compressed file is damaged")}}function $t(e,t){let n=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(n)?"utf-16le":/^(\xfe\xff|\0)/.test(n)?"utf-16be":null,a=s===null?["utf-8","windows-1252"]:[s];for(let c of a)try{let i=new TextDecoder(c,{fatal:!0}).decode(e),l=c==="windows-1252";if(!/\0|^\s*</.test(i)&&!(l&&He.test(i)))return i}catch{}let o=/^[\w.-]+$/.test(t)?t:`"${t}"`,r="neither a picture nor a table in text that the page can read";throw new w(`${r}; to make a page of it, type: stereodel web ${o}`)}async function Le(e,t,n,s,a){if(e.type.startsWith("image/"))return n.pass("globe",e);let{messages:o}=n,r=`${e.name}:`,c=i=>`${i}${/[.?!]$/.test(i)?"":"."} Nothing has changed.`;try{let i=await mt(e.name,new Uint8Array(await e.arrayBuffer()),t,a);if("room"in i)return n.pass(i.room,e,i.columns);let{leftOut:l,wrong:d}=i,h=()=>{o.close(),s(i)};if(l===0)return h();let p=l===1?"this row":`these ${x(l)} rows`;o.show(r,c(d),{words:`Open without ${p}`,act:h})}catch(i){if(!(i instanceof w))throw i;let{message:l,columns:d}=i;if(d.length<2)return o.show(r,c(l));let h=(t==="lonlat"?["Longitude","Latitude"]:["x","y"]).map((m,f)=>{let u=$("select","",...d.map(b=>$("option","",b)));return u.selectedIndex=f,$("label","field column",`${m} `,u)}),p=()=>{let[m,f]=h.map(u=>J(u,"select").value);return Le(e,t,n,s,[m,f])};o.show(`Which columns of ${e.name}?`,"",{words:"Open",act:()=>{p()}},h)}}var _t=7;function St(e,t="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?vt:xt(a,t);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var vt={type:"Polygon",coordinates:[[...te(-180,-90,180,90),[-180,-90]]]};function xt(e,t){let n=kt(e.flatMap((c,i)=>ae(c,e[(i+1)%e.length])),t),s=Math.round((n[n.length-1][0]-n[0][0])/360),a=s===0?n:Et(n,s),o=c=>Number(c.toFixed(_t)),r=Lt(a).map(c=>[c.map(([i,l])=>[o(i),o(l)])]);return r.length===1?{type:"Polygon",coordinates:r[0]}:{type:"MultiPolygon",coordinates:r}}function kt(e,t){let n=oe(Float64Array.from([...e,e[0]].flatMap(R)),t),s=[];for(let a=0;a<n.length;a+=2){let o=s[s.length-1]?.[0]??n[a];s.push([n[a]+360*Math.round((o-n[a])/360),n[a+1]])}return s}function Et(e,t){let n=t>0?90:-90,s=t>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),r=Re(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),c=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),i=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),l=[[-180,r],...c,...i,[180,r]],d=t>0?l:l.reverse();return[...d,[d[d.length-1][0],n],[d[0][0],n],d[0]]}function Re(e,t,n){return e[0]===t[0]?e[1]:e[1]+(n-e[0])/(t[0]-e[0])*(t[1]-e[1])}function Lt(e){let t=e.map(([o])=>o),n=Math.floor((Math.min(...t)+180)/360),s=Math.ceil((Math.max(...t)+180)/360),a=[];for(let o=n;o<Math.max(s,n+1);++o){let r=e.slice(0,-1).map(([i,l])=>[i-360*o,l]),c=he(he(r,-180,1),180,-1);c.length>2&&a.push([...c,c[0]])}return a}function he(e,t,n){let s=[];return e.forEach((a,o)=>{let r=e[(o+1)%e.length],[c,i]=[n*(a[0]-t)>=0,n*(r[0]-t)>=0];c&&s.push(a),c!==i&&a[0]!==t&&r[0]!==t&&s.push([t,Re(a,r,t)])}),s}var pe=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),fe=2**15,Rt=class{width;height;texels;levels;constructor(e,t){if(this.width=z(t,"width",2,2**20),this.height=t/2,e.length!==4*this.width*this.height){let a=`four for each of ${t} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new F(Pt(e));let n=ie(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,pe];this.levels=new F(H(Uint8Array,n,"raster_levels",...s))}warp(e,t){return this.painted(e,[-1,1,2/t,2/t],t,t)}painted(e,t,n,s,a=!0){z(n,"width",1,fe),z(s,"height",1,fe);let o=e.inverse(),r=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),i=[...[this.texels,this.levels,this.width,this.height,pe],r,Float64Array.of(...t),n,s,a?1:0];return H(Uint8ClampedArray,4*n*s,"warp_raster",...i)}};function Pt(e){let t=Uint8Array.from(e);for(let n=0;n<t.length;++n)n%4!==3&&(t[n]=Math.floor((t[n]*t[n|3]+127)/255));return t}var Ot=4096,Pe=512,Dt=2,Nt=.3,At=.01;async function Mt(e,t,n){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>At){let c=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;t.show(`${e.name}:`,`the picture ${c??"cannot be read"}. Nothing has changed.`);return}let a=[],o=s,r=Math.round(Math.min(s.width,Ot)/2);do{let c=$("canvas",{width:2*r,height:r}),i=c.getContext("2d",{willReadFrequently:!0});i.drawImage(o,0,0,2*r,r),a.push(i.getImageData(0,0,2*r,r)),[o,r]=[c,Math.round(r/2)]}while(2*r>=Pe);s.close(),t.close(),n(new zt(e.name,a))}var zt=class{name;#e;letters={ink:"rgb(255, 255, 255)",accent:"rgb(245, 160, 98)",halo:"rgb(24 26 28 / 0.55)"};constructor(e,t){this.name=e,this.#e=t.map(({data:n,width:s})=>new Rt(n,s))}draw(e,t,n,s){let a=Math.max(1,Math.ceil(2*t.r*(s?Nt:Math.min(Dt,devicePixelRatio)))),o=({width:l})=>!s||l<=Pe*n.magnification,r=this.#e.find(o)??this.#e[this.#e.length-1],c=new ImageData(r.painted(n,[-1,1,2/a,2/a],a,a,!1),a,a),i=$("canvas",{width:a,height:a});i.getContext("2d").putImageData(c,0,0),e.within({region:l=>se(l,t)},()=>e.picture(i,t.x-t.r,t.y-t.r,2*t.r,2*t.r))}},G={ink:"ink",halo:"paper",size:24,align:"center"},ue={...G,ink:"ink-2",size:13};async function Oe(e,t){let{width:n,paint:s,owner:a}=e;if(!a)return e;let o=ge(a.title,1.9*n/G.size),r=o.length*30+(o.length>0?6:0),c=new Image;if(a.legend){let h=a.legend.replace("<svg ",`<svg color="${t}" font-family='${A}' `);c.src=`data:image/svg+xml,${encodeURIComponent(h)}`,await c.decode()}let i=r+e.height+8,l=ge(a.source,2.1*n/ue.size),d=i+c.height;return{...e,title:a.title?`${a.title}. ${e.title}`:e.title,height:d+(l.length>0?l.length*17+10:0),paint(h){o.forEach((p,m)=>h.label(p,n/2,26+30*m,G)),h.within({corner:[0,r]},()=>s(h)),a.legend&&h.picture(c,(n-c.width)/2,i,c.width,c.height),l.forEach((p,m)=>h.label(p,n/2,d+14+17*m,ue))}}}function ge(e,t){let n=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=n[n.length-1];a!==void 0&&a.length+s.length<t?n[n.length-1]=`${a} ${s}`:n.push(s)}return n}var Tt=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalDelaunay, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import ColorScale, DotStyle, LineStyle, SizeScale, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.interpolation import contours
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
radius = 1.349  # of circles of 150 km, degrees
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[owned] table = {file}  # as the page exports it
[owned] places = table.lonlat
[!owned places] places = {places}
[scaled] values, scale = table.column({valued}), {scale}
[scaled isolines] net = SphericalDelaunay.from_lonlat(places{latitude})
[scaled isolines] levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
[scaled isolines] isolines = [line.lonlat for line in contours(net, values, levels)]
[scaled fills] shades = scale(values)
[owned !scaled] shades = {shades}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude}{title})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[owned fills]     globe.add_cells(SphericalVoronoi.from_lonlat(places{latitude}), colors=shades, style=None)
[owned fills !picture]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule(10, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot(10, radius, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[scaled isolines]     for style in (LineStyle("#fdfcfa", 2.4), LineStyle("#1b1b1b", 0.8)):
[scaled isolines]         globe.add_lines(isolines, style=style, name="isolines")
[owned]     globe.add_points(places, {points})
[places !owned]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, radius)], color=WASH, style=RED)
[named names]     globe.add_labels(places, {words}, size=13.0, movable=True)
    return globe


[!bubble] globe = earth()
[!bubble !owned] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble !owned] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble !owned] page = globe.page(lens, View({view}), width={width})
[!bubble owned] page = globe.page(lens, View({view}), width={width}, legend=True)
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,It=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#7b7b7b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=INK)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=GRAY)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=INK)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), GRAY.color, GRAY.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="flat", style=LineStyle("#1b1b1b61", 1.1))
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,jt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, fisheye, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
shift = frame.max() / {reach} * np.array([{middle}])
flat = projection.forward(points) - shift
flat[(points == pole).all(axis=1)] = 1e9  # a site at the pole is far away
lens = fisheye({lens})
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def arcs(pairs):
    """Great circles between sites, through the lens."""
    return [lens.image_of(SphereArc.great(points[a], points[b])) for a, b in pairs]


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(lens.inverse()(axes[seen] @ view.matrix))]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=INK)
[triangles facets] scene.add_arcs(arcs(delaunay.edges), name="delaunay", style=INK)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=GRAY)
[cells] ridge_arcs = map(lens.image_of, SphericalVoronoi(delaunay).ridge_arcs())
[cells] scene.add_arcs(ridge_arcs, name="voronoi", style=GRAY)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_arcs(arcs(edges[count == 1]), name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(lens.image_of(bubble), name="bubble", color=WASH)
[bubble aimed] scene.add_circles([lens.image_of(bubble)], style=RED)
[bubble aimed] scene.add_arcs(arcs(pairs), name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right - shift + image.point - far, right - shift + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right - shift + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right - shift + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] for corners in fan[np.linalg.det(points[fan]) > 0].tolist():  # others close the hull
[step]     scene.add_region(arcs(zip(corners, corners[1:] + corners[:1])), name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_arcs(arcs(before.edges), name="delaunay", style=INK)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=INK)
[step] scene.add_arcs(arcs(fan[:, [2, 0]]), name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_arcs(arcs(fan[:, :2]), name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{step}], name="sites", style=DOT)
scene.add_points(lens(points)[:{step}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(lens(points)[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
[pole] at = left + ball * view.project(lens(pole))
[pole front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[pole !front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
[pole] sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,De=200,Ne="cities().lonlat[cities().population >= 2_000_000]",Ct=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${Ne})`,Ft={cities:Ne,airports:`airports().lonlat[np.unique(${Ct})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function Ht(e,t,n,s){let{sites:a,view:o,bubble:r,aim:c,step:i}=e,l=re(e.map,e.twin),d=f=>i===null&&e.isOn(f),h=[...d("bubble")&&r?.sites||[],...i===null?e.held:[i.site]],p={facets:a.facetCount>0,hemisphere:a.hasClosing,step:i!==null&&i.before.dimension===2,aimed:r!==null,held:h.length>0,pole:l!==null,front:l!==null&&l[2]>=0,hatched:d("seeing")||d("closing")&&a.hasClosing},m={...s,sites:Ft[n.set]??B(a.lonlat,`${Ae(n.file)}.lonlat`),pole:_(t.pole),view:_(o.middle),aim:R(c).join(", "),lens:`(${_(R(t.lens.focus))}), magnification=${t.lens.magnification}`,held:h.join(", "),step:i===null?"":i.site+1};return V(jt,m,p,d)}function Wt(e,t,n,s){let{sites:a,sheet:o,view:r,isOn:c}=e,[i,l]=[e.p,e.q].filter(u=>u!==null),{contact:d,height:h}=t,p=a.count===0?[3,2]:s,m={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:i!==void 0,pair:l!==void 0&&i!==l,pole:t.seenPole!==null},f={points:B(a.places,`np.loadtxt(${JSON.stringify(n.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${_(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:_(r.middle),width:t.width,height:h,scale:t.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[i,l].join(", "),shown:JSON.stringify(t.grounds)};return V(It,f,m,c)}function Ut(e,t,n,s,a){let{lens:o,sight:r,from:c,to:i,before:l,after:d,pointer:h}=e,{places:p,latitude:m,picture:f,resolution:u}=t,b=o==="bubble",{owner:y,names:O,lonlat:q=new Float64Array(0)}=p??{},I=Ae(p?.name??""),j=p===null||m==="spherical"?"":`, latitude="${m}"`,D=C=>{let N=`(${_(R(C))})`;return j===""?N:`lonlat_to_xyz(${N}${j})`},Y=({middle:C,roll:N})=>_([...C,N]).replace(/, -?0$/,""),Me={focus:D(r.lens.focus),magnification:_([r.lens.magnification]),taken:`${D(c.center)}, ${_([c.radius])}`,filled:`${D(i.center)}, ${_([i.radius])}`,title:"",...y?.lines,file:I,places:B(q,`${I}.lonlat`),words:q.length>2*De?`${I}.column("name")`:JSON.stringify(O),latitude:j,picture:JSON.stringify(f?.name??""),resolution:u,pointer:D(h),before:Y(l),view:Y(b?d:r.view),width:_([1.03*s*(b?2:1)])},{points:ze,scale:Te}=y?.lines??{};return V(Tt,Me,{bubble:b,picture:f,places:p,pointed:a,owned:ze,scaled:Te,named:O},n)}function V(e,t,n,s){let a=l=>l in n?!!n[l]:s(l),r=e.split(`
`).flatMap(l=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(l);return d?.split(" ").every(m=>m.startsWith("!")?!a(m.slice(1)):a(m))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(l,d)=>String(t[d]??l)),c=r.replace(/^(from|import) .*\n/gm,""),i=l=>new RegExp(`\\b${l.split(" as ").pop()}\\b`).test(c);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(l,d,h)=>{let p=h.split(", ").filter(i);return p.length===0?"":`${d}${p.join(", ")}
`})}function B(e,t){if(e.length>2*De)return t;let n=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=n.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return n.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var Ae=e=>`read_points(${JSON.stringify(e)})`;function _(e){return e.map(t=>M(t,7)).join(", ")}function Gt(e,t){let n=new Blob([t]),s=$("a",{href:URL.createObjectURL(n),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}async function Vt(e){let{title:t,width:n,height:s,weight:a,paint:o}=await Oe(e,L().ink),r=new Ce(n,s,L(),a);return o(r),r.text(t)}async function Bt(e,t){let{width:n,height:s,weight:a,paint:o}=await Oe(e,L().ink),r=$("canvas",{width:Math.round(n*t),height:Math.round(s*t)}),c=r.getContext("2d");return c.fillStyle=L().paper,c.fillRect(0,0,r.width,r.height),o(new K(c,n,s,t,L(),a)),new Promise((i,l)=>{r.toBlob(d=>d===null?l(new Error("the picture is too large")):i(d))})}async function qt(e,t){let n=e.cloneNode(!0);n.querySelector("#block-state")?.remove();let s=new Blob([t]).stream().pipeThrough(new CompressionStream("deflate")),a=new Uint8Array(await new Response(s).arrayBuffer()),o=btoa(Array.from(a,r=>String.fromCharCode(r)).join(""));return n.querySelector("#block-kernel").before($("script",{type:"text/plain",id:"block-state"},o),`
`),new Blob([`<!doctype html>
`,n.outerHTML,`
`],{type:"text/html"})}var Yt={csv:ht,download:Gt,geojson:St,globePython:Ut,liftPython:Wt,openPanorama:Mt,openPoints:Le,savedPage:qt,sheetPng:Bt,sheetSvg:Vt,spherePython:Ht};Object.assign(document.currentScript,{offers:Yt});})();
